// Colours of maps. ColorBrewer's Reds, Blues, Purples and Oranges: even steps of lightness, told
// apart by colour-blind eyes. Nothing is the page's own paper, light or dark.

const isDark = matchMedia('(prefers-color-scheme: dark)');
const isPrinted = matchMedia('print');
const darkNow = () => isDark.matches && !isPrinted.matches;

const stops = {
  light: {
    signed: [
      [103, 0, 13], [203, 24, 29], [251, 106, 74], [252, 187, 161], [254, 229, 217],
      [255, 255, 255], [222, 235, 247], [158, 202, 225], [66, 146, 198], [8, 81, 156], [8, 48, 107]
    ],
    drag: [
      [63, 0, 125], [118, 42, 131], [158, 120, 190], [255, 255, 255], [253, 190, 133],
      [217, 110, 20], [140, 60, 0]
    ],
    sizes: [[255, 255, 255], [218, 218, 235], [158, 154, 200], [106, 81, 163], [63, 0, 125]],
  },
  dark: {
    signed: [
      [254, 224, 210], [252, 146, 114], [239, 59, 44], [153, 20, 20], [84, 10, 15], [25, 25, 25],
      [8, 48, 90], [15, 82, 148], [48, 130, 190], [120, 182, 220], [215, 232, 247]
    ],
    drag: [
      [226, 200, 240], [170, 120, 200], [80, 40, 100], [25, 25, 25], [110, 60, 10], [241, 163, 64],
      [255, 226, 180]
    ],
    sizes: [[25, 25, 25], [63, 30, 110], [106, 81, 163], [158, 154, 200], [226, 224, 242]],
  },
};

/** 256 colours between the stops, as pixels of an ImageData. */
function pixelsOf(palette) {
  const all = stops[darkNow() ? 'dark' : 'light'][palette];
  const pixels = new Uint32Array(256);
  const bytes = new Uint8Array(pixels.buffer);
  for (let i = 0; i < 256; ++i) {
    const at = (i / 255) * (all.length - 1);
    const first = Math.min(Math.floor(at), all.length - 2);
    for (let k = 0; k < 3; ++k)
      bytes[4 * i + k] = all[first][k] + (at - first) * (all[first + 1][k] - all[first][k]);
    bytes[4 * i + 3] = 255;
  }
  return pixels;
}

/** Fills an ImageData with values: full colour at `most`, nothing for what is not known. */
function paint(image, values, most, palette, place = (i) => i) {
  const colours = pixelsOf(palette);
  const pixels = new Uint32Array(image.data.buffer);
  const one = palette === 'sizes' ? 255 / most : 127.5 / most;
  const zero = palette === 'sizes' ? 0 : 127.5;
  for (let i = 0; i < values.length; ++i) {
    const index = Math.round(zero + one * values[i]);
    pixels[place(i)] = Number.isNaN(index) ? 0 : colours[Math.max(0, Math.min(255, index))];
  }
}

/** CSS of a bar that runs through the colours. @param half  from 0 on alone */
function gradient(palette, half = false) {
  const all = stops[darkNow() ? 'dark' : 'light'][palette];
  const shown = half ? all.slice((all.length - 1) / 2) : all;
  return `linear-gradient(to right, ${shown.map((c) => `rgb(${c})`).join(', ')})`;
}

/** A colour of the page's own: "--blue". */
const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
