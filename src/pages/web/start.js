// Draws what the page holds. Without scripts it has its answers and tables; pictures need these.

for (const place of document.querySelectorAll('.chart')) makeChart(place, dataIn(place));
const frames = document.getElementById('frames');
if (frames) {
  frames.hidden = false;
  showFrames(frames, dataIn(frames));
}
