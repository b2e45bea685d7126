# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the cells of a notebook in order, as Jupyter would, and compares what they print with what is stored.

usage: run_notebook.py NOTEBOOK [--store]      --store: stores what they print instead, and their pictures
"""

import base64
import contextlib
import io
import json
import os
import sys
import tempfile
from pathlib import Path

os.environ["MPLBACKEND"] = "Agg"
DOTS_PER_INCH = 72  # pictures stay small


def pictures():
    """PNG files of all figures that are open, which are closed."""
    pyplot = sys.modules.get("matplotlib.pyplot")
    for number in pyplot.get_fignums() if pyplot else ():
        file = io.BytesIO()
        pyplot.figure(number).savefig(file, format="png", dpi=DOTS_PER_INCH, bbox_inches="tight", metadata={"Software": None})
        yield file.getvalue()
    if pyplot:
        pyplot.close("all")


def outputs_of(printed, images):
    if printed:
        yield {"name": "stdout", "output_type": "stream", "text": printed.splitlines(keepends=True)}
    for image in images:
        text = {"image/png": base64.b64encode(image).decode() + "\n", "text/plain": ["<Figure>"]}
        yield {"data": text, "metadata": {}, "output_type": "display_data"}


def main():
    path, store = Path(sys.argv[1]).resolve(), "--store" in sys.argv[2:]
    notebook = json.loads(path.read_text(encoding="utf-8"))
    names = {"__name__": "__main__"}
    count = assertions = 0
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for cell in notebook["cells"]:
            if cell["cell_type"] != "code":
                continue
            count += 1
            source = "".join(cell["source"])
            assertions += source.count("assert ")
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(source, f"{path.name}, cell {count}", "exec"), names)
            images = list(pictures())
            stored = "".join(text for output in cell["outputs"] if output["output_type"] == "stream" for text in output["text"])
            if store:
                cell["outputs"], cell["execution_count"] = list(outputs_of(printed.getvalue(), images)), count
            elif printed.getvalue() != stored:
                sys.exit(f"{path.name}, cell {count} prints\n{printed.getvalue()}and not\n{stored}(--store stores it)")
        os.chdir("/")
    if count < 5 or assertions < 5:
        sys.exit(f"{path.name}: {count} cells with {assertions} assertions are too few to show anything")
    if store:
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{path.name}: {count} cells, {assertions} assertions")


if __name__ == "__main__":
    main()
