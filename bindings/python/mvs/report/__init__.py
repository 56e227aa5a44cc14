"""Reports on valves: tables and pictures in one HTML file that needs nothing else.

``python -m mvs.report --out DIR [FILE ...]`` closes the shipped valve, a leaking variant of it and
the valves of the files, repeats the founding paper's study of repairs (mvs.study), prints tables
and writes DIR/report.html. Needs pyvista and matplotlib
(``pip install 'libmvs[report]'``); no display.
"""
