# A surgeon's assistant with the command: a dilated annulus and a torn chord; which repair serves?
set -eu
mvs generate --shape founding -o healthy.obj
mvs op healthy.obj annulus-scale --factor 1.2 -o dilated.obj
mvs op dilated.obj chord-remove --chord P2/3 -o sick.obj
mvs close sick.obj -o sick_closed.obj
mvs chords sick_closed.obj --sort tension | head -5
mvs sweep sick.obj --op "ring size=30:36:2" --csv rings.csv --sort regurgitant_orifice_area_mm2 | tee rings.txt
[ "$(wc -l <rings.csv)" -eq 5 ]
best=$(grep -o "ring_size_mm=[0-9.]*" rings.txt | head -1 | cut -d= -f2)
mvs op sick.obj neochord --head PM1 --site P2:0.5:0.95 --length 17 -o tied.obj
mvs op tied.obj ring --size "$best" -o repaired.h5
mvs close repaired.h5 -o repaired_closed.h5
mvs convert repaired_closed.h5 -o for_paraview.vtm
mvs op healthy.obj nosuch 2>sentence.txt && exit 1
grep -q "chord-length" sentence.txt
leak() { mvs measure "$1" --json | sed -n 's/.*"regurgitant_orifice_area_mm2": *\([0-9.e-]*\).*/\1/p'; }
echo "before: $(leak sick_closed.obj) mm2, with a ring of $best mm: $(leak repaired_closed.h5) mm2"
awk "BEGIN { exit !($(leak repaired_closed.h5) < 0.2 * $(leak sick_closed.obj)) }"
