# docs/case2.svg: gnuplot -c docs/case2.gp FRF.csv FRF_WITHOUT_HARMONIC_0.csv COMPARE.csv
set datafile separator ","
set datafile commentschars "#"
set terminal svg size 720,420 font "sans,13" background rgb "white"
set output "docs/case2.svg"
set xlabel "omega [rad/s]"
set ylabel "amplitude of x [m]"
set key top right
set xrange [3:18]; set yrange [0:28]
plot ARG1 every ::1 using 1:3 with lines lw 2.5 lc rgb "#1f4e79" title "harmonic balance, H = 10", \
     ARG2 every ::1 using 1:3 with lines lw 1.5 dt 2 lc rgb "#888888" title "without harmonic 0, as the paper", \
     "< awk -F, '$3==\"match\"' ".ARG3 using 1:5 with points pt 6 ps 1 lw 2 lc rgb "#c0392b" title "time integration (CVODE)"
