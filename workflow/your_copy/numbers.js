"use strict";

// Numbers as people type them, with a decimal point or a decimal comma.
const numbers = (() => {
  const NUMBER = /^[-+]?(\d+[.,]?\d*|[.,]\d+)(e[-+]?\d+)?$/i;
  const UNCLEAR = /^[-+]?[1-9]\d{0,2},\d{3}$/; // a decimal comma, or one between thousands

  // NaN for other text, and where a comma is unclear unless `commas` says that it is a decimal one.
  function read(text, commas = false) {
    const plain = text.trim().replace(/[\u2212\u2013]/g, "-");
    const value = NUMBER.test(plain) && (commas || !UNCLEAR.test(plain)) ? Number(plain.replace(",", ".")) : NaN;
    return Number.isFinite(value) ? value : NaN;
  }

  const is_one = (text) => !Number.isNaN(read(text, true));
  const is_unclear = (text) => is_one(text) && Number.isNaN(read(text));

  return { read, is_one, is_unclear };
})();
