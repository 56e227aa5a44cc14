"""An application of ``mvs``: reports on valves as one self-contained HTML file.

``python -m mvs.report --out DIR [FILE ...]`` closes the shipped valve, a leaking variant of it and
the valves of the files, repeats the founding paper's study of repairs (mvs.study), prints tables
and writes DIR/report.html. Needs the extra ``report`` (``pip install 'libmvs[report]'``: pyvista,
matplotlib), but no display. ``import mvs`` does not import it, and it uses only public
names of mvs.
"""
