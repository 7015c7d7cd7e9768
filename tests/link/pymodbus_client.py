"""Reads and writes every area of a PLC that runs areas.awl, with pymodbus, and provokes each exception.

Usage: pymodbus_client.py tcp PORT | rtu DEVICE. Ends with 0 when everything was as it should be.
"""

import sys

from pymodbus.client import ModbusSerialClient, ModbusTcpClient


def connected(way: str, place: str):
    if way == "tcp":
        client = ModbusTcpClient("127.0.0.1", port=int(place), timeout=5)
    else:
        client = ModbusSerialClient(place, baudrate=115200, timeout=2)
    if not client.connect():
        sys.exit(f"pymodbus cannot connect to {place}")
    return client


class Plc:
    """Answers that must be as wanted; each check counts."""

    def __init__(self, client, product: str):
        self.client = client
        self.product = product
        self.checks = 0

    def same(self, what: str, got, wanted) -> None:
        self.checks += 1
        if got != wanted:
            sys.exit(f"{what}: got {got}, wanted {wanted}")

    def bits(self, what: str, answer, wanted: list) -> None:
        self.same(what, [int(bit) for bit in answer.bits[: len(wanted)]], wanted)

    def registers(self, what: str, answer, wanted: list) -> None:
        self.same(what, answer.registers, wanted)

    def refused(self, what: str, answer, code: int) -> None:
        self.same(what, answer.isError() and answer.exception_code, code)

    def good(self, what: str, answer) -> None:
        self.same(what, answer.isError(), False)


def bits(plc: Plc) -> None:
    client = plc.client
    for name, first in (("Q", 0), ("M", 1000), ("S", 3000)):
        plc.good(f"{name} on", client.write_coil(first + 3, True))
        plc.bits(f"{name} read", client.read_coils(first, count=8), [0, 0, 0, 1, 0, 0, 0, 0])
        plc.good(f"{name} many", client.write_coils(first, [True, False, True] + [False] * 7))
        plc.bits(f"{name} read again", client.read_coils(first, count=10), [1, 0, 1] + [0] * 7)
        plc.good(f"{name} off", client.write_coils(first, [False] * 128))
    plc.bits("SM0.0", client.read_coils(2000, count=1), [1])
    plc.bits("T bits", client.read_coils(4000, count=256), [0] * 256)
    plc.bits("C bits", client.read_discrete_inputs(5000, count=256), [0] * 256)
    plc.bits("I", client.read_discrete_inputs(0, count=128), [0] * 128)
    plc.bits("I by function 1", client.read_coils(6000, count=16), [0] * 16)
    for name, address in (("SM", 2000), ("T", 4037), ("C", 5005), ("I", 6000), ("no area", 128)):
        plc.refused(f"write {name}", client.write_coil(address, True), 2)
    plc.refused("read no area", client.read_discrete_inputs(999, count=1), 2)
    plc.refused("read beyond the end", client.read_coils(127, count=2), 2)


def registers(plc: Plc) -> None:
    client = plc.client
    plc.good("VW0", client.write_register(0, 0x1234))
    plc.good("VW2", client.write_registers(1, [1, 2, 3]))
    plc.registers("VW0 to VW6", client.read_holding_registers(0, count=4), [0x1234, 1, 2, 3])
    plc.good("120 words", client.write_registers(10, list(range(120))))
    plc.registers("120 words again", client.read_holding_registers(10, count=120), list(range(120)))
    answer = client.readwrite_registers(read_address=0, read_count=2, write_address=1, values=[77])
    plc.registers("write and read", answer, [0x1234, 77])
    plc.good("T37", client.write_register(6037, 5))
    plc.registers("T37 and T38", client.read_holding_registers(6037, count=2), [5, 0])
    plc.good("C5", client.write_register(7005, 6))
    plc.registers("C5", client.read_holding_registers(7005, count=1), [6])
    plc.good("AC0 to AC3", client.write_registers(8000, list(range(1, 9))))
    plc.registers("AC0 to AC3", client.read_holding_registers(8000, count=8), list(range(1, 9)))
    plc.good("AQW2", client.write_register(8013, 16000))
    plc.registers("AQW0 and AQW2", client.read_holding_registers(8012, count=2), [0, 16000])
    plc.registers("AIW", client.read_input_registers(6, count=26), [0] * 26)
    plc.refused("V the program has not", client.read_holding_registers(130, count=1), 2)
    plc.refused("T the program has not", client.write_register(6036, 1), 2)
    plc.refused("HC0", client.write_register(8008, 1), 2)
    plc.refused("AIW after the last", client.read_input_registers(31, count=2), 2)
    plc.refused("33 timers", client.read_holding_registers(6000, count=33), 3)
    plc.good("VW0 back", client.write_registers(0, [0] * 4))


def identification(plc: Plc) -> None:
    client = plc.client
    answer = client.read_device_information(read_code=2)
    names = {number: text.decode() for number, text in answer.information.items()}
    plc.same("identification", (names[0], names[1], names[6]), ("uno200", plc.product, "areas"))
    plc.refused("no such object", client.read_device_information(read_code=4, object_id=9), 2)
    plc.refused("no such function", client.mask_write_register(address=0, and_mask=0xF2, or_mask=0x25), 1)


def main() -> None:
    _, way, place = sys.argv
    client = connected(way, place)
    # On the network it is the simulator that answers.
    plc = Plc(client, "simulator" if way == "tcp" else "Arduino Uno")
    for part in (bits, registers, identification):
        part(plc)
    client.close()
    print(f"pymodbus: {plc.checks} answers as they should be")


main()
