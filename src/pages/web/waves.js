// Which ripples on a skin stand out of the noise: a map for each component, a square for each wave.

/** @param d  what report/json/waves_json.cpp writes */
function showWaves(place, d) {
  const grid = {rows: d.y.length, columns: d.z.length, y: 0, z: 0, dy: 1, dz: 1};
  const long = (length) =>
      length === null ? '∞' : `${brief(length * d.length.factor)} ${d.length.label}`.trim();
  const ends = (all) => [long(all[0]), long(all[all.length - 1])];
  const maps = d.maps.map(({title, times}) => {
    const own = element('div');
    place.append(own);
    const map = makeMap(own, grid, {
      title,
      label: `Which ripples stand out of the noise: ${title}`,
      palette: 'sizes',
      ends: {y: ends(d.y), along: 'wave along y →', z: ends(d.z)},
      where: (row, column) => `wave of ${long(d.y[row])} along y, ${long(d.z[column])} along z`
    });
    map.show({
      values: times,
      most: d.most,
      unit: {label: 'times the noise, or more', factor: 1},
      touching: (cell) => times[cell] >= 1,
      say: (cell) => `${brief(times[cell])} times the noise`
    });
    map.onPoint = (at) => maps.forEach((one) => one.point(at));
    return map;
  });
}
