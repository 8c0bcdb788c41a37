# docs/case2.svg, from three results of hbmcheck in csv: gnuplot -c docs/case2.gp FRF FRF_WITHOUT_HARMONIC_0 COMPARE
set datafile separator ","
set terminal svg size 720,420 font "sans,13" background rgb "white"
set output "docs/case2.svg"
set xlabel "omega [rad/s]"
set ylabel "amplitude of x [m]"
set key top right
set xrange [3:18]; set yrange [0:36]
only(state, file) = "< grep -v '^#' ".file." | awk -F, 'NR > 1 {if ($9 == \"".state."\") print; else print \"\"}'"
plot only("yes", ARG1) using 1:3 with lines lw 2.5 lc rgb "#1f4e79" title "harmonic balance, H = 20: stable", \
     only("no", ARG1) using 1:3 with lines lw 2.5 dt 3 lc rgb "#1f4e79" title "unstable", \
     "< grep -v '^#' ".ARG2 every ::1 using 1:3 with lines lw 1.5 dt 2 lc rgb "#999999" title "without harmonic 0, as in the paper", \
     "< awk -F, '$3 == \"match\"' ".ARG3 using 1:5 with points pt 6 ps 1 lw 2 lc rgb "#c0392b" title "time integration (CVODE)"
