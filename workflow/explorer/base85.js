"use strict";

// The bytes of a table of the page: five digits say four bytes. It is shorter than base 64.
function bytes(text) {
  const digits =
    "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;,=>?@^_`{|}~";
  const padded = text.padEnd(5 * Math.ceil(text.length / 5), "~");
  const found = new DataView(new ArrayBuffer((4 * padded.length) / 5));
  for (let i = 0; i < padded.length; i += 5) {
    let four = 0;
    for (let k = i; k < i + 5; k++) four = 85 * four + digits.indexOf(padded[k]);
    found.setUint32((4 * i) / 5, four);
  }
  return found.buffer.slice(0, Math.floor((4 * text.length) / 5));
}
