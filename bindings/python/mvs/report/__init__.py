"""An application of ``mvs``: reports on valves as one self-contained HTML file.

``python -m mvs.report FILE ...`` closes the valves of the files, prints tables and writes
report.html; without a FILE it closes the shipped valve and a leaking variant of it, applies every
operation and repeats the founding paper's study of repairs (mvs.study). Needs the extra ``report`` (``pip install 'libmvs[report]'``: pyvista,
matplotlib), but no display. ``import mvs`` does not import it, and it uses only public
names of mvs.
"""
