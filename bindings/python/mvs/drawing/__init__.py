"""Pictures of valves (extra ``report``: pyvista, matplotlib); no display is needed.

    closed.plot()                          # in a notebook; closed.plot("chords").save("valve.png")
    closed.to_pyvista()["leaflets"].plot(scalars="stretch_1")

    from mvs.drawing.geometry import Drawing
    from mvs.drawing.maps import coaptation_map, section_plot, strain_map
    from mvs.drawing.pictures import picture, view_from_atrium

The functions return PNG bytes and take the size of the picture in mm; `import mvs` imports none of
the extra packages.
"""
