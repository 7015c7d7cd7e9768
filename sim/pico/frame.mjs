// Frames of Modbus RTU. What requests mean is not known here.

/** A request to unit 1, or its answer, with what is around it. */
export function frame(request) {
  const bytes = [1, ...request];
  let crc = 0xffff;
  for (const byte of bytes) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >> 1) ^ 0xa001 : crc >> 1;
  }
  return [...bytes, crc & 0xff, crc >> 8];
}
