"""What the blocks of lang/st/blocks must give, computed by NumPy and SciPy in double precision.

`python3 reference.py` writes a table beside it for each program in ../cases/library that has one:
a row for each scan. A column of a variable of the program, such as Main.x, is written before the
scan; one of an instance's output, such as Main.Filter.Y, is what must come out. Numbers with a
point are REAL.
"""

import numpy as np
from scipy import integrate, signal

ROWS = 120
STEP = np.concatenate([np.ones(50), np.zeros(10)])
NOISE = np.random.default_rng(1).uniform(-1, 1, ROWS - len(STEP)).astype(np.float32)
X = np.concatenate([STEP, NOISE]).astype(float)
FS = 100.0


def text(value):
    if isinstance(value, (bool, np.bool_, int, np.integer)):
        return str(int(value))
    return np.format_float_positional(value, precision=9, unique=False, trim="0")


def write(name, columns):
    with open(name + ".csv", "w", encoding="ascii", newline="\n") as file:
        file.write(",".join("Main." + column for column in columns) + "\n")
        for row in zip(*columns.values()):
            file.write(",".join(text(value) for value in row) + "\n")


def filtered(kind):
    return signal.sosfilt(kind, X)


def butterworth(order, frequency, kind):
    return filtered(signal.butter(order, frequency, kind, fs=FS, output="sos"))


def bessel(order, frequency, kind):
    return filtered(signal.bessel(order, frequency, kind, norm="mag", fs=FS, output="sos"))


def held(numerator, denominator):
    """What comes out at the end of a period through which X is held: z times the usual output."""
    top, bottom, _ = signal.cont2discrete((numerator, denominator), 1 / FS)
    return signal.lfilter(np.atleast_2d(top)[0][1:], bottom, X)


def filters():
    for kind, name in (("low", "low_pass"), ("high", "high_pass")):
        for order in (2, 4):
            columns = {
                "x": X,
                "Flat.Y": butterworth(order, 3.0, kind),
                "Bessel.Y": bessel(order, 3.0, kind),
            }
            if (order, kind) == (2, "low"):
                columns["Slow.Y"] = butterworth(2, 0.05, "low")
            write(f"{name}_{order}", columns)
    write("band_pass", {"x": X, "Filter.Y": signal.lfilter(*signal.iirpeak(10, 10 / 4, fs=FS), X)})
    write("band_stop", {"x": X, "Filter.Y": signal.lfilter(*signal.iirnotch(10, 10 / 4, fs=FS), X)})
    write("transfer_1", {"x": X, "Filter.Y": signal.lfilter([0.5, 0.25], [1, -0.5], X)})
    second = signal.lfilter([0.5, 0.25, 0.125], [1, -0.5, 0.25], X)
    write("transfer_2", {"x": X, "Filter.Y": second})
    write("lag", {"x": X, "Filter.Y": held([2.0], [0.05, 1.0]), "Direct.Y": 2 * X})
    shifted = lambda n: np.concatenate([np.zeros(n), X])[:ROWS]
    write("delay", {"x": X, "None.Y": X, "Five.Y": shifted(5), "Most.Y": shifted(32)})


def notch():
    """The hum of the case, and zeros and poles as the block says."""
    hum = 2 + np.sin(2 * np.pi * 50 * np.arange(200) / 1000)
    turn = np.exp(2j * np.pi * 50 / 1000)
    b, a = signal.zpk2tf([turn, turn.conj()], [0.9 * turn, 0.9 * turn.conj()], 1)
    write("notch", {"Hum.Y": hum, "Filter.Y": signal.lfilter(b.real * a.sum() / b.sum(), a, hum)})


def controllers():
    """The linear part by SciPy: parts of a sum of filters of setpoint and process value."""
    t = 1 / FS
    sp = np.concatenate([np.zeros(2), np.full(58, 0.5), np.full(60, 0.25)])
    pv = 0.5 * signal.lfilter([0.1], [1, -0.9], sp).astype(np.float32).astype(float)
    p = lambda x: 2.0 * x
    i = lambda x: signal.lfilter([5.0 * t], [1, -1], x)
    d = lambda x: signal.lfilter(np.array([0.5, -0.5]) / (0.03 + t), [1, -0.03 / (0.03 + t)], x)
    e = sp - pv
    for name, u in (("pid", p(e) + i(e) + d(e)), ("pi_d", p(e) + i(e) - d(pv)),
                    ("i_pd", i(e) - p(pv) - d(pv))):
        write(name, {"sp": sp, "pv": pv, "Loop.U": u})


def generators():
    n = np.arange(ROWS)
    write("sine", {"Wave.Y": 1 + 3 * np.sin(2 * np.pi * 2.5 * n / FS)})
    write("square", {"Wave.Y": np.where(n % 5 < 3, 2.0, -1.0)})
    times, values = [0, 4, 6, 8, 9], [-1.0, 3.0, 3.0, -1.0, -1.0]
    write("trapezoid", {"Wave.Y": np.interp(n % 9, times, values)})
    write("ramp", {"Slope.Y": np.interp(n, [0, 4], [1.0, 3.0])})
    state, series = 0x12345678, []
    for _ in n:
        state ^= state << 13 & 0xFFFFFFFF
        state ^= state >> 17
        state ^= state << 5 & 0xFFFFFFFF
        series.append(2.0 * np.int32(np.uint32(state)) / 2.0**31)
    write("noise", {"Hiss.Y": np.array(series)})


def models():
    write("rc_model", {"x": X, "Circuit.Y": held([1.0], [0.05, 1.0])})
    late = np.concatenate([np.zeros(3), held([3.0], [0.05, 1.0])])[:ROWS]
    write("oven_model", {"x": X, "Oven.TEMPERATURE": 20 + late})
    turns = held([2.0], [0.05, 1.0, 0.0])
    write("motor_model", {"x": X, "Motor.SPEED": held([2.0], [0.05, 1.0]), "Motor.TURNS": turns})
    # Within half of the beam.
    write("ball_model", {"x": 0.1 * X, "Ball.PLACE": 0.1 * held([7.0], [1.0, 0.0, 0.0]),
                         "Ball.SPEED": 0.1 * held([7.0], [1.0, 0.0])})
    tank()


def tank():
    """The block's steps, and how far they are from the solution of the differential equation."""
    inflow = 1 + X
    level, levels = 0.0, []
    for flow in inflow:
        level = max(0.0, level + (flow - np.sqrt(level)) / 0.5 / FS)
        levels.append(level)
    write("tank_model", {"x": inflow, "Tank.LEVEL": np.array(levels)})
    exact, found = 0.0, []
    for flow in inflow:
        slope = lambda _, y: (flow - np.sqrt(np.maximum(y, 0))) / 0.5
        exact = integrate.solve_ivp(slope, (0, 1 / FS), [exact], rtol=1e-10, atol=1e-12).y[0][-1]
        found.append(exact)
    off = np.max(np.abs(np.array(levels) - found)) / np.max(found)
    assert off < 0.01, off
    print(f"tank: off by {off:.2%} of the largest level at most")


filters()
notch()
models()
controllers()
generators()
