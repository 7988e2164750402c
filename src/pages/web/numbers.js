// Numbers as people write them, and the values of maps as the page holds them.

/** "0.0123", "1.2e7": so many digits, without trailing zeros. */
function brief(number, digits = 3) {
  if (!Number.isFinite(number)) return '–';
  const rounded = Number(number.toPrecision(digits));
  const size = Math.abs(rounded);
  const text =
      size !== 0 && (size >= 1e6 || size < 1e-4) ? rounded.toExponential() : String(rounded);
  return text.replace('e+', 'e').replace('-', '−');
}

/** The place of a cell; the middle of a surface is 0 in spite of rounding. */
function placeOfCell(first, step, index) {
  const place = first + step * index;
  return Math.abs(place) < 1e-9 * step ? 0 : place;
}

/**
 * "0.9817 ± 0.0017": rounded to the deviation's first two digits if these are below 20, else one;
 * large numbers, and those below the smallest, with one power of ten for both. As plus_minus of
 * numeric/number_text.cpp.
 */
function plusMinus(value, deviation, smallest = 1e-3) {
  if (!Number.isFinite(value)) return '–';
  if (!(deviation > 0)) return brief(value, 4);
  let power = Math.floor(Math.log10(deviation));
  if (Math.round(deviation / 10 ** (power - 1)) < 20) --power;
  const fixed = (number, digits) => {
    const text = number.toFixed(digits);
    return Number(text) === 0 ? text.replace('-', '') : text.replace('-', '−');
  };
  const largest = Math.max(Math.abs(value), deviation);
  if (power > 4 || largest < smallest) {
    const common = Math.floor(Math.log10(largest)), unit = 10 ** common;
    const digits = Math.max(0, common - power);
    return `(${fixed(value / unit, digits)} ± ${fixed(deviation / unit, digits)})e${common}`
        .replace('e-', 'e−');
  }
  const step = 10 ** power;
  const rounded = (number) =>
      power < 0 ? fixed(number, Math.min(15, -power)) : fixed(Math.round(number / step) * step, 0);
  return `${rounded(value)} ± ${rounded(deviation)}`;
}

/** A value in a unit {label, factor}. */
function withUnit(value, deviation, unit) {
  const text = plusMinus(value * unit.factor, deviation * unit.factor);
  return unit.label ? `${text} ${unit.label}` : text;
}

/**
 * The values of all frames, from the text that report/json/frames_json.cpp writes: a character of
 * 92 a value, two for large ones; each frame has its step. Where all frames have the same values,
 * they are there once.
 */
function unpack(packed) {
  if (!packed) return null;
  const {size, steps, text, sizes} = packed;
  const symbol = (at) => {
    const code = text.charCodeAt(at);
    return code === 32 ? 25 : code === 33 ? 57 : code - 35;
  };
  const values = new Float32Array(size * steps.length);
  for (let i = 0, at = 0; i < values.length; ++i) {
    let value = symbol(at++);
    if (!sizes && value < 86) {
      value -= 43;
    } else if (!sizes) {
      const index = (value - 86) * 92 + symbol(at++);
      value = index === 551 ? NaN : index < 276 ? 43 + index : 232 - index;
    }
    values[i] = value * steps[Math.floor(i / size)];
  }
  return {
    size,
    of: (frame) => {
      const first = steps.length === 1 ? 0 : frame * size;
      return values.subarray(first, first + size);
    }
  };
}
