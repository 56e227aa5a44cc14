"""The report is an application: the module does not import it, and it uses public names only."""

import ast
import subprocess
import sys
from pathlib import Path

import mvs
import mvs.mesh
import mvs.study
import pytest

PACKAGE = Path(mvs.__file__).parent
REPORT = [p for p in sorted((PACKAGE / "report").glob("*.py")) if p.exists()]
# applications: their pages share pieces of HTML
APPLICATIONS = {PACKAGE / "report", PACKAGE / "imaging", PACKAGE / "fitting"}
OTHERS = [p for p in sorted(PACKAGE.rglob("*.py"))
          if not APPLICATIONS & {*p.parents} and p.exists()]
PUBLIC = {"mvs": {*mvs.__all__, "__version__", "study"}, "mvs.mesh": set(vars(mvs.mesh)),
          "mvs.study": set(mvs.study.__all__)}
DRAWING = {p.stem for p in (PACKAGE / "drawing").glob("*.py")}


def imports_of(path):
    """Every module imported by a file with the imported names; relative ones begin with a dot."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, []) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield "." * node.level + (node.module or ""), [alias.name for alias in node.names]


def test_the_module_imports_no_plotting_package():
    code = ("import sys, mvs, mvs.study, mvs.mesh\n"
            "names = {name.split('.')[0] for name in sys.modules} | set(sys.modules)\n"
            "print(names & {'matplotlib', 'pyvista', 'vtk', 'vtkmodules', 'PIL', 'jinja2',"
            " 'mvs.report'})")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "set()"


@pytest.mark.parametrize("path", OTHERS, ids=lambda path: path.name)
def test_no_other_file_imports_the_report(path):
    for module, names in imports_of(path):
        assert "report" not in module.split(".") and "report" not in names


@pytest.mark.parametrize("path", REPORT, ids=lambda path: path.name)
def test_the_report_uses_public_names_of_the_module(path):
    for module, names in imports_of(path):
        assert not module.startswith("..")
        if module.startswith("mvs.drawing."):
            assert module.split(".")[2] in DRAWING
            assert not any(name.startswith("_") for name in names)
        elif module.split(".")[0] == "mvs" and names:
            assert set(names) <= PUBLIC[module]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute) and getattr(node.value, "id", None) == "mvs":
            assert node.attr in PUBLIC["mvs"], node.attr
