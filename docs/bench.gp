# docs/bench.svg, from two results of hbmcheck bench in csv: gnuplot -c docs/bench.gp CASE2 R2 [OUTPUT]
set datafile separator ","
out = ARGC > 2 ? ARG3 : "docs/bench.svg"
if (out[strlen(out)-3:] eq ".png") set terminal pngcairo size 1080,460 font "sans,11"; else set terminal svg size 1080,460 font "sans,12" background rgb "white"
set output out
set logscale xy
set format x "10^{%T}"; set format y "10^{%T}"
set xlabel "processor time of one solution [s]"
set grid lc rgb "#dddddd"
set xrange [8e-6:3]; set yrange [1e-20:1e-1] # the lowest seven decades are the key's
set key bottom left Left reverse samplen 3
rows(method, file) = "< awk -F, '/^omega,accuracy/ {exit} $2 == \"".method."\" && $16 == \"solved\"' ".file
set style line 1 pt 1 ps 0.9 lw 1.5 lc rgb "#777777"
set style line 2 pt 7 ps 0.9 lw 2.5 lc rgb "#1f4e79"
set style line 3 pt 5 ps 0.9 lw 2.5 dt 2 lc rgb "#c0392b"
set style line 4 pt 4 ps 0.9 lw 1.5 dt 3 lc rgb "#c0392b"
set style line 5 pt 9 ps 0.9 lc rgb "#e08e0b"
set style line 6 pt 8 ps 0.9 lc rgb "#8a5a00"
set style line 7 pt 13 ps 1.2 lc rgb "#000000"
set style line 8 pt 11 ps 1.4 lc rgb "#000000"
set style line 9 pt 14 ps 1.0 lw 1.5 lc rgb "#c0392b"
set style line 10 pt 12 ps 0.9 lw 1.5 lc rgb "#e08e0b"
names = "'HBM, sampled forces' 'HBM, exact forces' 'exact law, shooting' 'exact law, marching' 'regularised law, shooting' 'regularised law, marching' 'scipy LSODA' 'exact law, closed form' 'exact law, scouted' 'regularised law, scouted'"
set multiplot layout 1,2 margins 0.07,0.99,0.13,0.93 spacing 0.06
do for [panel = 1:2] {
  file = panel == 1 ? ARG1 : ARG2
  set title panel == 1 ? "case 2, omega = 9" : "blade (Table 10 case 2), omega = 708.5"
  if (panel == 1) { set ylabel "error of the amplitude, at these or finer settings" } else { unset ylabel }
  plot rows("hbm_sampled", file) using 10:9 with points ls 1 notitle, \
       rows("hbm_exact", file) using 10:9 with linespoints ls 2 notitle, \
       rows("exact_shooting", file) using 10:9 with linespoints ls 3 notitle, \
       rows("exact_marching", file) using 10:9 with linespoints ls 4 notitle, \
       rows("regularised_shooting", file) using 10:9 with points ls 5 notitle, \
       rows("regularised_marching", file) using 10:9 with points ls 6 notitle, \
       rows("scipy_lsoda", file) using 10:9 with points ls 7 notitle, \
       rows("closed_shooting", file) using 10:9 with points ls 8 notitle, \
       rows("exact_scouted", file) using 10:9 with linespoints ls 9 notitle, \
       rows("regularised_scouted", file) using 10:9 with points ls 10 notitle, \
       for [i = 1:(panel == 1 ? 1 : 0)] keyentry with points ls i title word(names, i), \
       for [i = 2:(panel == 1 ? 4 : 0)] keyentry with linespoints ls i title word(names, i), \
       for [i = 5:(panel == 2 ? 10 : 0)] keyentry with points ls i title word(names, i)
}
unset multiplot
