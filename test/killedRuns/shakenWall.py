# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
"""A small wall under a sine of the ground, which writes a state every 10 steps: the case of the tests in this folder."""
import os
import subprocess
import sys

header = "FoamFile { version 2.0; format ascii; class dictionary; object %s; }\n"
step, interval, end = 0.001, 0.01, 0.8
files = {
    "constant/g": "value (0 -9.81 0);\n",
    "constant/materialProperties": "density 2000;\n",
    "constant/contactProperties": "friction { type Coulomb; mu 0.5; flowRule nonAssociative; }\n",
    "constant/groundMotion": "direction (1 0 0);\nacceleration { type sine; amplitude 6; duration 1; cycles 4; }\n",
    "system/blockTextureDict": """dimensions 2;
texture { type courses; unit (0.4 0.2); thickness 1; rows ( (0.5 1 1 0.5) (1 1 1) (0.5 1 1 0.5) (1 1 1) ); }
supports { ground { type ground; } }
""",
    "system/controlDict": f"""application contactDynamics;
startFrom latestTime; startTime 0; stopAt endTime; endTime {end}; deltaT {step};
writeControl runTime; writeInterval {interval};
functions {{ energy {{ type energy; }} }}
""",
}


def make(applications, case):
    for name, text in files.items():
        path = os.path.join(case, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(header % os.path.basename(name) + text)
    run(applications, "blockTexture", case)


def run(applications, application, case):
    done = subprocess.run([os.path.join(applications, application), "-case", case], capture_output=True, text=True,
                          check=False)
    if done.returncode != 0:
        sys.exit(f"{application} ended with {done.returncode}\n{done.stdout[-2000:]}{done.stderr}")
    return done.stdout
