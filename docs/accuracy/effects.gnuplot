# What effects cost: build/release/bench/bench_effects docs/accuracy/effects.csv && gnuplot docs/accuracy/effects.gnuplot
set terminal svg size 560,475 dynamic noenhanced font 'sans-serif,15' background '#ffffff'
set output 'docs/accuracy/effects.svg'
set datafile separator ','
set title 'Instructions per reading, counted by callgrind' font ',14'
set lmargin at screen 0.32
set rmargin at screen 0.97
set tmargin at screen 0.92
set bmargin at screen 0.02
unset key
unset xtics
set border 2
set xrange [0:860]
set yrange [14.7:-0.7]
set ytics nomirror scale 0
set style fill solid noborder
plot 'docs/accuracy/effects.csv' every ::1 using (0):0:(0):2:($0-0.36):($0+0.36):ytic(1) with boxxyerror lc rgb '#0072B2', \
     '' every ::1 using 2:0:(sprintf($2 < 10 ? '%.1f' : '%.0f', $2)) with labels left offset 0.5,0 font ',13'
