// Draws what the page holds. Without scripts it has its answers and tables; pictures need these.

for (const place of document.querySelectorAll('.chart')) makeChart(place, dataIn(place));
for (const place of document.querySelectorAll('.sortable')) makeSortable(place, dataIn(place));
for (const place of document.querySelectorAll('.waves')) showWaves(place, dataIn(place));
for (const place of document.querySelectorAll('.frames')) {
  place.hidden = false;
  showFrames(place, dataIn(place));
}
