// Small helpers of all pictures.

/** An element with attributes and children, which are elements or text. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** Runs `draw` where the colours of the page or its medium change. */
function whenColoursChange(draw) {
  isDark.addEventListener('change', draw);
  isPrinted.addEventListener('change', draw);
}

/** The data that stand inside an element, as JSON in a script that does nothing. */
const dataIn = (place) =>
    JSON.parse(place.querySelector('script[type="application/json"]').textContent);
