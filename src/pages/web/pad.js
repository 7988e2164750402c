// A pad in section (pages/pad_drawing.cpp): a load on top, the stress that it causes inside.

/**
 * @param place  holds the <svg>
 * @param d      with `field`: the stress, or of a line that of a strip's unit load
 * @param say    words for a cell of the surface
 */
function makePad(place, d, say) {
  const find = (name) => place.querySelector(`[data-part=${name}]`);
  const pressure = find('pressure'), drag = find('drag'), inside = find('inside');
  const svg = inside.closest('svg'), readout = element('p', {class: 'readout'}, ' ');
  place.append(readout);
  const surface = Number(inside.getAttribute('y')), tall = Number(inside.getAttribute('height'));
  const count = d.grid.rows, step = 1000 / count, field = d.field ?? {rows: 0};
  const rows = field.rows, columns = field.columns ?? count;
  const [given, ...kernels] =
      [field.stress, field.normal, field.tangential].map((one) => one && unpack(one).of(0));
  const stress = given ?? new Float32Array(rows * columns);
  const canvas = element('canvas', {width: columns, height: rows || 1});

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
  const compute = (loads) => {
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
  };
  const drawField = () => {
    const context = canvas.getContext('2d'), image = context.createImageData(columns, rows);
    for (let i = 0; i < stress.length; ++i) {
      image.data.set(stress[i] < 0 ? [192, 57, 43] : [33, 102, 172], 4 * i);
      image.data[4 * i + 3] = 255 * Math.min(1, Math.abs(stress[i]) / d.largest.normal) ** 0.8;
    }
    context.putImageData(image, 0, 0);
    inside.setAttribute('href', canvas.toDataURL());
  };

  svg.addEventListener('pointermove', (event) => {
    const at =
        new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    const share = at.x / 1000, depth = (at.y - surface) / tall;
    if (share < 0 || share >= 1 || depth >= 1) return;
    const length = (x) => brief(x * d.length.factor), cell = Math.floor(count * share);
    const y = length(placeOfCell(d.grid.y, d.grid.dy, cell));
    if (depth < 0)
      readout.textContent = `y ${y} ${d.length.label}: ${say(cell)}`;
    else if (rows)
      readout.textContent =
          `y ${y}, depth ${length(depth * inside.dataset.depth)} ${d.length.label}: stress ` +
          withUnit(
              stress[Math.floor(depth * rows) * columns + Math.floor(share * columns)], 0,
              d.stress);
  });
  svg.addEventListener('pointerleave', () => readout.textContent = ' ');
  return {
    show(loads) {
      pressure.setAttribute('d', area(loads[0]));
      if (loads[1]) drag.setAttribute('d', arrows(loads[1]));
      if (!given) compute(loads);
      if (rows) drawField();
    },
  };
}
