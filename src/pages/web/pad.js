// A line's pad in section (pages/pad_drawing.cpp): the load of one frame on top, the stress that it
// causes inside.

/** @param place  holds the <svg>. @param d  with `field`, the stress of a strip's unit load */
function makePad(place, d) {
  const find = (name) => place.querySelector(`[data-part=${name}]`);
  const pressure = find('pressure'), drag = find('drag'), inside = find('inside');
  const count = d.grid.rows, surface = Number(pressure.dataset.surface), step = 1000 / count;
  const rows = d.field ? d.field.rows : 0;
  const kernels =
      rows ? [d.field.normal, d.field.tangential].map((one) => one && unpack(one).of(0)) : [];
  const canvas = element('canvas', {width: count, height: rows || 1});

  const area = (values) => `M0 ${surface}L` +
      Array
          .from(
              values,
              (value, i) => `${((i + 0.5) * step).toFixed(1)} ${
                  (surface - 85 * value / d.largest.normal).toFixed(1)}`)
          .join('L') +
      `L1000 ${surface}Z`;
  const arrows = (values) => {
    const every = Math.ceil(count / 41);
    let path = '';
    for (let i = 0; i < count; i += every) {
      const length = 36 * values[i] / d.largest.drag,
            head = Math.sign(length) * Math.min(6, Math.abs(length));
      if (!(Math.abs(length) >= 1.5)) continue;
      path += `M${((i + 0.5) * step).toFixed(1)} ${surface - 5}h${length.toFixed(1)}m${- head} -4l${
          head} 4l${- head} 4`;
    }
    return path;
  };
  const stress = new Float32Array(count * rows);
  let last = null;
  const field = (loads) => {
    stress.fill(0);
    loads.forEach((values, which) => {
      const kernel = kernels[which];
      if (!values || !kernel) return;
      for (let row = 0; row < rows; ++row)
        for (let at = 0; at < count; ++at) {
          const from = row * (2 * count - 1) + at + count - 1;
          let sum = 0;
          for (let i = 0; i < count; ++i) sum += kernel[from - i] * values[i];
          stress[row * count + at] += sum;
        }
    });
    const context = canvas.getContext('2d'), image = context.createImageData(count, rows);
    for (let i = 0; i < stress.length; ++i) {
      image.data.set(stress[i] < 0 ? [192, 57, 43] : [33, 102, 172], 4 * i);
      image.data[4 * i + 3] = 255 * Math.min(1, Math.abs(stress[i]) / d.largest.normal) ** 0.8;
    }
    context.putImageData(image, 0, 0);
    inside.setAttribute('href', canvas.toDataURL());
  };
  return {
    show(loads) {
      last = loads;
      pressure.setAttribute('d', area(loads[0]));
      if (loads[1]) drag.setAttribute('d', arrows(loads[1]));
      if (rows) field(loads);
    },
  };
}
