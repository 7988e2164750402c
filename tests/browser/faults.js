// What is wrong with the page as it is laid out now: a list of sentences. Evaluated by pages_test.py.
(() => {
  const faults = [];
  const shown = (e) => e.getClientRects().length > 0 && e.checkVisibility();
  const brief = (e) => `<${e.tagName.toLowerCase()}> "${e.textContent.trim().slice(0, 40)}"`;
  // The part that two boxes share, as lengths.
  const shared = (a, b) => [Math.min(a.right, b.right) - Math.max(a.left, b.left),
                            Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top)];

  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width)
    faults.push(`overflow: the page is ${document.documentElement.scrollWidth} wide in ${width}`);

  // A letter on a screen is 11 pixels high at least: on a telephone 12, and a little for rounding.
  const least = matchMedia("print").matches ? 9 : 11;
  for (const svg of [...document.querySelectorAll("svg")].filter(shown)) {
    if (svg.getAttribute("role") !== "img" || !svg.getAttribute("aria-label"))
      faults.push(`name: an <svg> does not say what it shows: ${svg.outerHTML.slice(0, 60)}`);
    const frame = svg.getBoundingClientRect();
    const texts = [...svg.querySelectorAll("text")].filter((t) => t.textContent.trim() && shown(t));
    const boxes = texts.map((t) => t.getBoundingClientRect());
    texts.forEach((text, i) => {
      const box = boxes[i];
      if (box.left < frame.left - 1 || box.right > frame.right + 1 || box.top < frame.top - 1 ||
          box.bottom > frame.bottom + 1)
        faults.push(`cut off: ${brief(text)}`);
      const scale = frame.width / svg.viewBox.baseVal.width;
      const size = scale * parseFloat(getComputedStyle(text).fontSize);
      if (size < least) faults.push(`small: ${brief(text)} is ${size.toFixed(1)} px high`);
      // Boxes are as high as a line, letters about two thirds of that.
      for (let j = 0; j < i; ++j) {
        const [across, down] = shared(box, boxes[j]);
        const line = Math.min(box.width, box.height, boxes[j].width, boxes[j].height);
        if (across > 0.3 * line && down > 0.3 * line)
          faults.push(`overlap: ${brief(texts[j])} and ${brief(text)}`);
      }
    });
  }

  // A canvas says what it shows, or lies under one that does, and is drawn in the pixels it has.
  for (const canvas of [...document.querySelectorAll("canvas")].filter(shown)) {
    const box = canvas.getBoundingClientRect();
    if (box.right > width + 1) faults.push(`cut off: ${canvas.className} ends at ${box.right}`);
    const chart = canvas.closest("[role=img]"), under = canvas.classList.contains("cells");
    if (!under && !chart?.getAttribute("aria-label"))
      faults.push(`name: a <canvas> does not say what it shows: ${canvas.outerHTML.slice(0, 60)}`);
    if (canvas.closest(".uplot") && Math.abs(canvas.width - devicePixelRatio * box.width) > 1.5)
      faults.push(`blurred: ${chart?.getAttribute("aria-label")} has ${canvas.width} pixels in ${box.width}`);
  }

  // The answer is on the first screen of a desk, and no verdict is out of sight on a telephone.
  const answers = document.querySelector(".answers");
  if (!answers) faults.push("answer: there is none");
  else if (width > 1000 && answers.getBoundingClientRect().bottom > 900)
    faults.push(`answer: it ends ${answers.getBoundingClientRect().bottom} pixels down`);
  for (const cell of document.querySelectorAll("td[data-label=verdict]")) {
    const box = cell.getBoundingClientRect();
    if (box.width === 0 || box.left < 0 || box.right > width + 1)
      faults.push(`verdict: ${brief(cell)} cannot be seen`);
  }

  // Blocks of text and pictures, the innermost ones.
  const blocks = [...document.querySelectorAll("h1, h2, p, li, tr, figcaption, svg, footer")]
      .filter(shown);
  const places = blocks.map((e) => e.getBoundingClientRect());
  blocks.forEach((block, i) => {
    for (let j = 0; j < i; ++j) {
      const [across, down] = shared(places[i], places[j]);
      if (across > 1 && down > 1 && !blocks[j].contains(block))
        faults.push(`overlap: ${brief(blocks[j])} and ${brief(block)}`);
    }
  });

  // Contrast of text with what lies behind it (WCAG 2.1, 1.4.3: 4.5).
  const rgb = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = (colour) => {
    const [r, g, b] = rgb(colour).slice(0, 3).map((c) => c / 255)
        .map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (e) => {
    for (; e; e = e.parentElement) {
      const colour = getComputedStyle(e).backgroundColor;
      if ((rgb(colour)[3] ?? 1) > 0) return colour;
    }
    return "rgb(255, 255, 255)";
  };
  for (const e of document.querySelectorAll("h1, h2, p, li, th, td, figcaption, footer, a")) {
    const [low, high] = [luminance(getComputedStyle(e).color), luminance(behind(e))]
        .sort((a, b) => a - b);
    const contrast = (high + 0.05) / (low + 0.05);
    if (contrast < 4.5) faults.push(`contrast: ${brief(e)} has ${contrast.toFixed(1)}`);
  }
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  if ((luminance(behind(document.body)) < 0.2) !== dark)
    faults.push(`colours: the paper is ${behind(document.body)} where ${dark ? "dark" : "light"} is asked for`);

  for (const figure of document.querySelectorAll("figure")) {
    const caption = figure.querySelector("figcaption");
    if (!figure.querySelector("svg, canvas, .bars")) faults.push(`figure: ${figure.id} has no picture`);
    if (!caption || caption.textContent.trim().length < 40)
      faults.push(`figure: ${figure.id} has no caption`);
    if (!caption?.querySelector("a[href]")) faults.push(`figure: ${figure.id} names no data`);
  }
  return {faults, links: [...document.querySelectorAll("[href]:not(use):not(image), [src]")].map(
      (e) => e.getAttribute("href") ?? e.getAttribute("src")),
      figures: document.querySelectorAll("figure").length,
      labels: document.querySelectorAll("svg text, .uplot, .map").length};
})()
