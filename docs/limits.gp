# docs/limits.svg, from LIMIT,DEGREES,AMPLITUDE of y with the tangents turned: gnuplot -c docs/limits.gp LIMITS. That file:
#   for limit in circle square; do for a in $(seq 0 3 360); do
#     set -- $(awk -v a=$a 'BEGIN {a *= atan2(0, -1)/180; printf "%.17g %.17g %.17g", cos(a), sin(a), -sin(a)}')
#     contact="{tangential_stiffness: 60, friction: 0.5, preload: 4, tangent: {x: $1, y: $2}, tangent_2: {x: $3, y: $1}, limit: $limit}"
#     hbmcheck frf cases/structures/plane.yaml --at 11.5 --set hbm.harmonics=7 --set contacts="[$contact]" --response y --format csv --quiet |
#       awk -F, -v of=$limit,$a '/^#/ {next} !found++ {for (i = 1; i <= NF; ++i) if ($i == "amplitude") c = i; next} {print of "," $c}'
#   done; done >LIMITS
set datafile separator ","
set terminal svg size 860,420 font "sans,13" background rgb "white"
set output "docs/limits.svg"
set polar; set angles degrees; set size square; unset border; unset raxis; unset xtics; unset ytics; set grid polar 45
set multiplot layout 1,2
set key at screen 0.02,0.02 left bottom Left reverse samplen 2
set title "largest traction, by its direction"
set rrange [0:1.5]; set rtics 0.5 scale 0; set trange [0:360]
set samples 721
plot 1 lw 2.5 lc rgb "#1f4e79" title "circle", 1/(abs(cos(t)) > abs(sin(t)) ? abs(cos(t)) : abs(sin(t))) lw 2 lc rgb "#c0392b" title "square", \
     1/(abs(cos(t - 30)) > abs(sin(t - 30)) ? abs(cos(t - 30)) : abs(sin(t - 30))) lw 1.5 dt 2 lc rgb "#c0392b" title "square, turned by 30 degrees"
unset key
set title "amplitude of y, by the angle of the tangents"
set rrange [0:0.16]; set rtics 0.05 scale 0
only(limit) = "< grep '^".limit.",' ".ARG1
plot only("circle") using 2:3 with lines lw 2.5 lc rgb "#1f4e79", only("square") using 2:3 with lines lw 2 lc rgb "#c0392b"
unset multiplot
