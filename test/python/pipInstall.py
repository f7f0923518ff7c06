# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""pip installs the Python package without a network, from what Debian's packages have: without --no-build-isolation it
would download setuptools. Skipped (77) where pip, setuptools or wheel is missing.

pipInstall.py ROOT
"""
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile

root = os.path.abspath(sys.argv[1])


def main():
    missing = [name for name in ("pip", "setuptools", "wheel") if importlib.util.find_spec(name) is None]
    if missing:
        print(f"{' and '.join(missing)} not installed: skipped")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        source, target = os.path.join(folder, "python"), os.path.join(folder, "installed")
        shutil.copytree(os.path.join(root, "python"), source,  # pip builds in there
                        ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        subprocess.run([sys.executable, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--target", target,
                        "--root-user-action=ignore", source], check=True)
        modules = {name for name in os.listdir(os.path.join(source, "drystone")) if name.endswith(".py")}
        installed = set(os.listdir(os.path.join(target, "drystone")))
        assert modules <= installed, f"not installed: {modules - installed}"
        done = subprocess.run([sys.executable, "-c", "import drystone, importlib.metadata as m; print(drystone.__file__); "
                               "print(m.version('drystone'))"], cwd=folder, env={**os.environ, "PYTHONPATH": target},
                              capture_output=True, text=True, check=True)
        where, version = done.stdout.split()
        assert where.startswith(target), where
        with open(os.path.join(root, "CMakeLists.txt"), encoding="utf-8") as file:
            assert f"project(drystone VERSION {version} " in file.read(), version
    return 0


if __name__ == "__main__":
    sys.exit(main())
