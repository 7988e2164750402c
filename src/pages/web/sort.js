// A table whose rows are sorted by a click on a column's title.

/** @param keys  a list for each row with what its cells are sorted by; null: behind all others */
function makeSortable(place, keys) {
  const body = place.querySelector('tbody');
  const rows = [...body.rows].map((row, i) => ({row, keys: keys[i]}));
  const titles = [...place.querySelectorAll('th')];
  const compare = (a, b) => typeof a === 'number' ? a - b : String(a).localeCompare(String(b));
  titles.forEach((title, column) => {
    const button = element('button', {type: 'button'}, title.textContent);
    title.replaceChildren(button);
    button.addEventListener('click', () => {
      const sign = title.getAttribute('aria-sort') === 'descending' ? 1 : -1;
      for (const other of titles) other.removeAttribute('aria-sort');
      title.setAttribute('aria-sort', sign < 0 ? 'descending' : 'ascending');
      rows.sort((a, b) => {
        const [one, other] = [a.keys[column], b.keys[column]];
        if (one === null || other === null) return (one === null) - (other === null);
        return sign * compare(one, other);
      });
      body.append(...rows.map(({row}) => row));
    });
  });
}
