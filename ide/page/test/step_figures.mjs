// The figures of step responses against what analysis says, in node: first and second order, a
// falling step, gaps, what never settles, what has no step. `node test/step_figures.mjs`.
import assert from "node:assert/strict";
import { loadSource } from "./load.mjs";

const { stepResponse } = await loadSource("src/plot/step.ts");

/** A function of seconds, sampled every millisecond. */
function sampled(value, seconds = 10) {
  const times = Array.from({ length: seconds * 1000 + 1 }, (_, ms) => ms);
  return { times, signal: times.map((ms) => value(ms / 1000)), wanted: null };
}
const all = ({ times }) => [times[0] ?? 0, times.at(-1) ?? 1];
const figures = (samples, range = all(samples)) => stepResponse(samples, range);
function near(measured, wanted, tolerance, what) {
  assert(Math.abs(measured - wanted) <= tolerance, `${what}: ${measured}, not ${wanted}`);
}

// A lag of first order, rising and falling, to its last value and to a set value.
const T = 0.8;
const lag = (time) => 1 - Math.exp(-Math.max(0, time) / T);
for (const [from, size] of [
  [0, 1],
  [2, 5],
  [10, -4],
  [-1, -0.001],
]) {
  const samples = sampled((time) => from + size * lag(time));
  for (const wanted of [null, from + size]) {
    const response = figures({ ...samples, wanted });
    const what = `a lag from ${from} by ${size}`;
    assert.equal(response.kind, "step", what);
    assert.equal(response.begin, 0);
    near(response.before, from, 1e-9, what);
    near(response.after, from + size, 1e-4 * Math.abs(size), what);
    near(response.rise, 2.1972 * T, 0.002, what);
    near(response.settling, 3.912 * T, 0.002, what);
    near(response.overshoot, 0, 1e-6, what);
    near(response.iae, Math.abs(size) * T, 0.002 * Math.abs(size), what);
    if (wanted === null) assert.equal(response.steadyError, null);
    else near(response.steadyError, 0, 1e-4 * Math.abs(size), what);
    assert.equal(response.missing, 0);
  }
}

// Second order with a damping of 0.5: the overshoot is exp(-π·D / √(1 - D²)).
const D = 0.5;
const W = 5;
const swing = (time) => {
  const root = Math.sqrt(1 - D * D);
  const angle = W * root * time;
  return 1 - Math.exp(-D * W * time) * (Math.cos(angle) + (D / root) * Math.sin(angle));
};
for (const size of [3, -3]) {
  const response = figures(sampled((time) => size * swing(time)));
  assert.equal(response.kind, "step");
  near(response.overshoot, 16.303, 0.01, "overshoot");
  near(response.rise, 1.6388 / W, 0.003, "rise");
  near(response.settling, 8.0759 / W, 0.003, "settling");
}

// It begins with the last change of the set value; the value before is the one before that.
const later = sampled((time) => 2 * lag(time - 1) + 3 * lag(time - 10), 20);
later.wanted = later.times.map((ms) => (ms < 1000 ? 0 : ms < 10_000 ? 2 : 5.5));
const second = figures(later);
near(second.begin, 10, 1e-9, "the last change");
near(second.before, 2, 1e-3, "before");
near(second.after, 5, 1e-3, "after");
near(second.rise, 2.1972 * T, 0.002, "rise");
near(second.steadyError, 0.5, 1e-3, "it does not reach the set value");
near(second.iae, 3 * T + 0.5 * 10, 0.02, "the error that stays is in the integral");
// In the range alone: the first step.
const one = figures(later, [500, 9999]);
near(one.begin, 1, 1e-9, "begin in a range");
near(one.rise, 2.1972 * T, 0.002, "rise in a range");
near(one.before, 0, 1e-9, "before in a range");

// Samples at changes alone are held until the next one.
const jump = { times: [0, 4000, 10_000], signal: [1, 3, 3], wanted: null };
const jumped = figures(jump);
assert.deepEqual([jumped.before, jumped.after, jumped.rise, jumped.overshoot], [1, 3, 0, 0]);
assert.equal(jumped.settling, 4);
assert.equal(jumped.iae, 8);
assert.equal(figures(jump, [3000, 9000]).settling, 1, "the sample before the range is held");

// What does not settle has no figures of a last value; its error has an integral.
for (const [what, value] of [
  ["a ramp", (time) => time],
  ["a swing that stays", (time) => 1 + Math.sin(7 * time)],
  ["a swing that grows", (time) => Math.exp(time / 2) * Math.sin(7 * time)],
  ["a lag that had no time", (time) => lag(time / 4)],
]) {
  const restless = figures(sampled(value));
  assert.equal(restless.kind, "restless", what);
  for (const key of ["after", "rise", "overshoot", "settling", "steadyError", "iae"])
    assert.equal(restless[key], null, `${what}: ${key}`);
}
near(figures({ ...sampled((time) => time), wanted: 10 }).iae, 50, 0.01, "integral of a ramp");

// Gaps: what happened in them is not known, and is in no integral.
function without(samples, from, to) {
  const signal = samples.signal.map((value, ms) => (ms >= from && ms < to ? null : value));
  return { ...samples, signal };
}
const whole = sampled(lag);
const middle = figures(without(whole, 800, 1000));
assert.equal(middle.kind, "step");
near(middle.missing, 0.2, 1e-9, "missing");
near(middle.rise, 2.1972 * T, 0.002, "a gap between 10 % and 90 %");
assert(middle.iae < T - 0.05, "a gap is in no integral");
const highest = figures(without(whole, 1700, 1900));
assert.equal(highest.rise, null, "90 % was reached in the gap");
near(highest.settling, 3.912 * T, 0.002, "but it settled after it");
assert.equal(figures(without(whole, 3000, 3300)).settling, null, "it settled in the gap");
assert.equal(figures(without(whole, 8000, 10_001)).kind, "nothing", "its end is not known");
const begun = figures(without(whole, 0, 10));
near(begun.before, lag(0.01), 1e-9, "the first value that is known");

// No samples, one, none that is known; no step.
const nothing = figures({ times: [], signal: [], wanted: 1 });
assert.equal(nothing.kind, "nothing");
assert.equal(nothing.iae, null);
assert.equal(figures({ times: [0], signal: [1], wanted: null }).kind, "nothing");
assert.equal(figures({ times: [0, 10], signal: [null, null], wanted: 1 }).kind, "nothing");
const constant = figures({ ...sampled(() => 2), wanted: 5 });
assert.equal(constant.kind, "constant");
assert.deepEqual([constant.before, constant.after, constant.steadyError], [2, 2, 3]);
near(constant.iae, 30, 1e-6, "the error of a constant");
for (const key of ["rise", "overshoot", "settling"]) assert.equal(constant[key], null);
console.log("the figures of step responses are those of analysis");
