// Small helpers of all pictures.

const svgSpace = 'http://www.w3.org/2000/svg';

/** An element with attributes and children, which are elements or text. */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** Runs `draw` before the next picture of the screen, once, however often it is asked to. */
function onceAFrame(draw) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      draw();
    });
  };
}

/** Runs `draw` where the colours of the page or its medium change. */
function whenColoursChange(draw) {
  isDark.addEventListener('change', draw);
  isPrinted.addEventListener('change', draw);
}

/** The data that stand inside an element, as JSON in a script that does nothing. */
const dataIn = (place) =>
    JSON.parse(place.querySelector('script[type="application/json"]').textContent);
