#include "pages/recording_script.hpp"

namespace tactile_net::pages {

// Plain JavaScript, no library: the page works from a disk, without a network.
std::string_view recording_script() noexcept {
  return R"js('use strict';
(() => {
  const by = id => document.getElementById(id);
  const d = JSON.parse(by('data').textContent);
  const unpack = p => {
    if (!p) return null;
    const bytes = atob(p.base64), view = new DataView(new ArrayBuffer(bytes.length));
    for (let i = 0; i < bytes.length; ++i) view.setUint8(i, bytes.charCodeAt(i));
    return Float32Array.from({length: bytes.length / 2}, (_, i) => p.unit * view.getInt16(2 * i, true));
  };
  const n = d.count, last = d.groups - 1;
  const normal = unpack(d.normal), tangential = unpack(d.tangential);
  const spread = {normal: unpack(d.normal_deviation), tangential: unpack(d.tangential_deviation)};
  const slider = by('frame'), pictures = [...document.querySelectorAll('svg.over-time')];

  // One frame: the traction along the array, drawn in a box of n x 100.
  const up = value => 100 * (d.high - value) / (d.high - d.low);
  const line = values => 'M' + Array.from(values, (v, i) => `${i + .5} ${up(v).toFixed(2)}`).join('L');
  const band = (values, deviations) => {
    const edge = sign => Array.from(values, (v, i) => `${i + .5} ${up(v + sign * 2 * deviations[i]).toFixed(2)}`);
    return 'M' + edge(1).concat(edge(-1).reverse()).join('L') + 'Z';
  };

  // One frame on the pad: pressure as an area on the surface, drag as arrows along it.
  const pad = by('pressure').dataset, surface = +pad.surface, step = 1000 / n;
  const tall = value => surface - 85 * value / d.largest;
  const pressure = values => `M0 ${surface}L` +
      Array.from(values, (v, i) => `${((i + .5) * step).toFixed(1)} ${tall(v).toFixed(1)}`).join('L') + `L1000 ${surface}Z`;
  const drag = values => {
    const every = Math.ceil(n / 41);
    let path = '';
    for (let i = 0; i < n; i += every) {
      const length = 36 * values[i] / d.drag, head = Math.sign(length) * Math.min(6, Math.abs(length));
      if (Math.abs(length) < 1.5) continue;
      const x = (i + .5) * step, y = surface - 5;
      path += `M${x.toFixed(1)} ${y}h${length.toFixed(1)}m${-head} -4l${head} 4l${-head} 4`;
    }
    return path;
  };

  // The stress inside: sums of the kernels of one strip.
  const rows = d.field ? d.field.rows : 0;
  const kernels = rows ? [unpack(d.field.normal), unpack(d.field.tangential)] : [];
  const canvas = document.createElement('canvas');
  canvas.width = n; canvas.height = rows;
  const field = (one, other) => {
    const stress = new Float32Array(n * rows);
    [one, other].forEach((values, which) => {
      if (!values || !kernels[which]) return;
      for (let r = 0; r < rows; ++r)
        for (let at = 0; at < n; ++at) {
          let sum = 0;
          const from = r * (2 * n - 1) + at + n - 1;
          for (let i = 0; i < n; ++i) sum += kernels[which][from - i] * values[i];
          stress[r * n + at] += sum;
        }
    });
    const context = canvas.getContext('2d'), image = context.createImageData(n, rows);
    stress.forEach((value, i) => {
      const size = Math.min(1, Math.abs(value) / d.largest);
      image.data.set(value < 0 ? [192, 57, 43] : [33, 102, 172], 4 * i);
      image.data[4 * i + 3] = 255 * Math.pow(size, .8);
    });
    context.putImageData(image, 0, 0);
    by('inside').setAttribute('href', canvas.toDataURL());
  };

  const show = k => {
    slider.value = k;
    const at = k * n, one = normal.subarray(at, at + n), other = tangential && tangential.subarray(at, at + n);
    by('normal-line').setAttribute('d', line(one));
    if (spread.normal) by('normal-band').setAttribute('d', band(one, spread.normal.subarray(at, at + n)));
    if (other) by('tangential-line').setAttribute('d', line(other));
    if (spread.tangential) by('tangential-band').setAttribute('d', band(other, spread.tangential.subarray(at, at + n)));
    by('pressure').setAttribute('d', pressure(one));
    if (other) by('drag').setAttribute('d', drag(other));
    if (rows) field(one, other);
    const said = d.said[k];
    by('where').textContent = said.time;
    by('answer').textContent = said.answer;
    by('trust').textContent = said.trust;
    by('trust').hidden = !said.trust;
    slider.setAttribute('aria-valuetext', said.time + ': ' + said.answer);
    for (const cursor of document.querySelectorAll('.cursor')) {
      cursor.setAttribute('x1', k + .5);
      cursor.setAttribute('x2', k + .5);
    }
  };
  slider.addEventListener('input', () => show(+slider.value));

  // Drag over a picture in time: all of them show that part. Double click: everything again.
  let from = 0, to = last + 1, begun = null;
  const view = (a, b) => {
    from = a; to = b;
    for (const svg of pictures) {
      const box = svg.viewBox.baseVal;
      svg.setAttribute('viewBox', `${a} ${box.y} ${b - a} ${box.height}`);
    }
    for (const clock of document.querySelectorAll('.clock')) {
      const ends = [a, Math.floor((a + b) / 2), b - 1];
      [...clock.children].forEach((span, i) => { span.textContent = d.said[Math.min(last, ends[i])].clock; });
    }
  };
  const place = (svg, event) => {
    const box = svg.getBoundingClientRect();
    return Math.max(0, Math.min(last, Math.floor(from + (to - from) * (event.clientX - box.left) / box.width)));
  };
  for (const svg of pictures) {
    svg.addEventListener('pointerdown', event => { begun = {x: event.clientX, at: place(svg, event)}; });
    svg.addEventListener('pointerup', event => {
      if (!begun) return;
      const end = place(svg, event), moved = Math.abs(event.clientX - begun.x) > 12;
      if (moved && Math.abs(end - begun.at) > 3) view(Math.min(begun.at, end), Math.max(begun.at, end) + 1);
      else show(end);
      begun = null;
    });
    svg.addEventListener('dblclick', () => view(0, last + 1));
  }
  by('live').hidden = false;
  show(d.start);
})();
)js";
}

}  // namespace tactile_net::pages
