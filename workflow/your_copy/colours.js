"use strict";

// The colour at each place of a picture, on white paper if it is transparent. Tiles of it are read when they are
// needed: a large picture as a whole would take too much memory.
function colours_of(picture) {
  const TILE = 256; // pixels
  const { naturalWidth: width, naturalHeight: height } = picture;
  const canvas = Object.assign(document.createElement("canvas"), { width: TILE, height: TILE });
  const pen = canvas.getContext("2d", { willReadFrequently: true });
  pen.fillStyle = "white";
  const tiles = new Map();
  function pixel(x, y) {
    const [i, k] = [Math.floor(x / TILE), Math.floor(y / TILE)];
    const name = `${i},${k}`;
    if (!tiles.has(name)) {
      pen.fillRect(0, 0, TILE, TILE);
      pen.drawImage(picture, -i * TILE, -k * TILE);
      tiles.set(name, pen.getImageData(0, 0, TILE, TILE).data);
    }
    const first = 4 * ((y - k * TILE) * TILE + x - i * TILE);
    return tiles.get(name).subarray(first, first + 3);
  }
  // Between the middles of pixels, which lie at halves.
  return ([u, v]) => {
    const [x, y] = [[u, width], [v, height]].map(([one, size]) => Math.min(size - 1.001, Math.max(0, one - 0.5)));
    const [i, k] = [Math.floor(x), Math.floor(y)];
    const [a, b, c, d] = [pixel(i, k), pixel(i + 1, k), pixel(i, k + 1), pixel(i + 1, k + 1)];
    const mixed = (one, other, share) => one + (other - one) * share;
    return [0, 1, 2].map((n) => mixed(mixed(a[n], b[n], x - i), mixed(c[n], d[n], x - i), y - k));
  };
}
