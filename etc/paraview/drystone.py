# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""Shows a case in ParaView: blocks with their edges, coloured by displacement, contact points coloured by state, and the
contact forces as arrows.

In ParaView:  Macros > Import new macro, once; then open VTK/blocks.vtp.series of a case (or nothing, in a ParaView that was
started in the case directory), and choose the macro. Select `motion` in the pipeline to change the magnification: its scale
factor is one less.

As a state: limitAnalysis and contactDynamics write a copy of this file with the name of the case as
VTK/paraviewState.py; File > Load State... opens it and shows the case.

Without a window:  pvbatch drystone.py CASE [--picture FILE] [--state FILE] [--time T] [--magnify M]
"""
import argparse
import os
import sys

from paraview import servermanager
from paraview.simple import (ColorBy, FindSource, GetActiveSource, GetActiveViewOrCreate, GetAnimationScene,
                             GetColorTransferFunction, GetOpacityTransferFunction, GetScalarBar, Glyph, OpenDataFile, RenameSource, Render,
                             ResetCamera, SaveScreenshot, SetActiveSource, Show, Hide, WarpByVector)

# The colours of the pictures: from blocks at rest to those that move most; points that are open, stick, slide.
clay = [(0.97, 0.94, 0.90), (0.93, 0.78, 0.62), (0.84, 0.54, 0.37), (0.65, 0.29, 0.18)]
stateColours = [0.0, 0.60, 0.60, 0.60, 1.0, 0.12, 0.35, 0.65, 2.0, 0.80, 0.15, 0.10]


# The case, in a copy that a run has written.
ownCase = None


def caseOfThisState():
    """The case that this file lies in, also when the folder was moved or copied; else the one it was written for."""
    here = os.path.dirname(os.path.dirname(os.path.abspath(__file__))) if "__file__" in globals() else ownCase
    return here if os.path.exists(os.path.join(here, "VTK", "blocks.vtp.series")) else ownCase


def caseOfActiveSource():
    """The folder of the case whose file is selected in the pipeline, or where ParaView was started."""
    source = GetActiveSource()
    names = getattr(source, "FileName", None) if source else None
    name = names[0] if isinstance(names, (list, tuple)) or hasattr(names, "__getitem__") and not isinstance(names, str) else names
    return os.path.dirname(os.path.dirname(name)) if name else os.getcwd()


def read(case, name):
    path = os.path.join(case, "VTK", name + ".vtp.series")
    if not os.path.exists(path):
        return None
    source = FindSource(name) or OpenDataFile(path)
    RenameSource(name, source)
    source.UpdatePipeline()
    return source


def extent(source):
    x0, x1, y0, y1, z0, z1 = source.GetDataInformation().GetBounds()
    return ((x1 - x0) ** 2 + (y1 - y0) ** 2 + (z1 - z0) ** 2) ** 0.5


def largest(information, name):
    """The largest length of a vector, or 0."""
    array = information.GetArray(name)
    return max(abs(bound) for bound in array.GetRange(-1)) if array else 0.0


def legend(bar, title, position):
    bar.Title, bar.ComponentTitle = title, ""
    bar.WindowLocation, bar.Position, bar.ScalarBarLength = "Any Location", position, 0.3
    bar.TitleFontSize = bar.LabelFontSize = 14
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]


def show(case, magnification, time):
    view = GetActiveViewOrCreate("RenderView")
    view.OrientationAxesVisibility = 1
    view.UseColorPaletteForBackground, view.Background = 0, [1, 1, 1]
    blocks = read(case, "blocks")
    if blocks is None:
        raise SystemExit(f"{case} has no VTK/blocks.vtp.series: run limitAnalysis or contactDynamics in it first")
    scene = GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    times = list(blocks.TimestepValues) if hasattr(blocks, "TimestepValues") else []
    scene.AnimationTime = view.ViewTime = time if time is not None else (times[-1] if times else 0)
    blocks.UpdatePipeline(scene.AnimationTime)
    size = extent(blocks)

    motion = WarpByVector(registrationName="motion", Input=blocks)
    motion.Vectors = ["POINTS", "pointDisplacement[m]"]
    # The points are where the blocks are: this adds to it.
    motion.ScaleFactor = magnification - 1
    Hide(blocks, view)
    display = Show(motion, view)
    display.Representation = "Surface With Edges"
    display.EdgeColor = [0.15, 0.13, 0.12]
    ColorBy(display, ("CELLS", "displacement[m]", "Magnitude"))
    display.RescaleTransferFunctionToDataRange(True)
    shades = GetColorTransferFunction("displacement[m]")
    furthest = shades.RGBPoints[-4]
    shades.RGBPoints = [value for i, shade in enumerate(clay) for value in (furthest * i / (len(clay) - 1), *shade)]
    shades.ColorSpace = "RGB"
    display.SetScalarBarVisibility(view, True)
    legend(GetScalarBar(shades, view), "displacement [m]", [0.86, 0.08])

    contacts = read(case, "contacts")
    if contacts is not None:
        contacts.UpdatePipeline(scene.AnimationTime)
        Hide(contacts, view)
        states = GetColorTransferFunction("state")
        states.InterpretValuesAsCategories = 1
        states.Annotations = ["0", "open", "1", "sticking", "2", "sliding"]
        states.IndexedColors = [value for i in range(3) for value in stateColours[4 * i + 1:4 * i + 4]]
        GetOpacityTransferFunction("state")
        joints = Glyph(registrationName="joints", Input=contacts, GlyphType="Sphere")
        joints.OrientationArray = ["POINTS", "No orientation array"]
        joints.ScaleArray = ["POINTS", "No scale array"]
        joints.ScaleFactor = 0.006 * size
        joints.GlyphMode = "All Points"
        forces = Glyph(registrationName="forces", Input=contacts, GlyphType="Arrow")
        forces.OrientationArray = ["POINTS", "contactForce[N]"]
        forces.ScaleArray = ["POINTS", "contactForce[N]"]
        force = largest(contacts.GetPointDataInformation(), "contactForce[N]")
        forces.ScaleFactor = 0.12 * size / force if force > 0 else 0
        forces.GlyphMode = "All Points"
        for glyphs in (joints, forces):
            shown = Show(glyphs, view)
            ColorBy(shown, ("POINTS", "state"))
        shown.SetScalarBarVisibility(view, True)
        legend(GetScalarBar(states, view), "contact points", [0.86, 0.6])

    if blocks.GetDataInformation().GetBounds()[4:6] == (0.0, 0.0):
        view.InteractionMode = "2D"
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 1], [0, 0, 0], [0, 1, 0]
    else:
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [1, -2, 1], [0, 0, 0], [0, 0, 1]
    ResetCamera(view)
    SetActiveSource(motion)
    Render(view)
    return view


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("case", nargs="?")
    parser.add_argument("--picture")
    parser.add_argument("--state")
    parser.add_argument("--time", type=float)
    parser.add_argument("--magnify", type=float, default=1)
    arguments = parser.parse_args(sys.argv[1:])
    if arguments.case:
        case = os.path.abspath(arguments.case)
    else:
        case = caseOfThisState() if ownCase else caseOfActiveSource()
    if arguments.picture:
        GetActiveViewOrCreate("RenderView").ViewSize = [1600, 1000]
    view = show(case, arguments.magnify, arguments.time)
    if arguments.picture:
        SaveScreenshot(arguments.picture, view, ImageResolution=[1600, 1000])
    if arguments.state:
        servermanager.SaveState(arguments.state)


main()
