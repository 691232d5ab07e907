"""Makes a wheel of the Python module for pip (PEP 517), without the network.

It builds the target vegard_python of the preset "release" in the checkout's build folder, so that what ./start.sh
has built is used again, and packs what `cmake --install --component python` installs, with the files of data/.
The build needs the packages of packages.txt and packages-python.txt.
"""
import base64
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
BUILD = SOURCE / "build" / "release"


def version():
    return re.search(r"project\(vegard VERSION ([0-9.]+)", (SOURCE / "CMakeLists.txt").read_text()).group(1)


def tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def metadata():
    return (f"Metadata-Version: 2.1\nName: vegard\nVersion: {version()}\n"
            "Summary: Simulates aurorae and fits them to photographs\n"
            "Requires-Python: >=3.11\nRequires-Dist: numpy\n")


def built_files(folder):
    """Files of the module by their names in the wheel, installed below `folder` and stripped."""
    def run(*command):
        subprocess.run(command, cwd=SOURCE, check=True)
    options = ["-DVEGARD_PYTHON=ON", f"-DPython_EXECUTABLE={os.path.realpath(sys.executable)}"]
    if not (BUILD / "CMakeCache.txt").exists():
        options.append("-DVEGARD_INSTRUCTION_SETS=this")
    run("cmake", "--preset", "release", *options)
    run("cmake", "--build", "--preset", "release", "--parallel", str(os.cpu_count()), "--target", "vegard_python")
    run("cmake", "--install", str(BUILD), "--prefix", folder, "--component", "python", "--strip")
    package = next(pathlib.Path(folder).rglob("vegard/__init__.py")).parent
    files = {f"vegard/{path.name}": path for path in package.iterdir() if path.is_file()}
    data = SOURCE / "data"
    files.update({f"vegard/data/{path.relative_to(data)}": path for path in data.rglob("*") if path.is_file()})
    return files


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    name = f"vegard-{version()}"
    information = f"{name}.dist-info"
    wheel = f"{name}-{tag()}.whl"
    with tempfile.TemporaryDirectory() as folder:
        contents = {member: path.read_bytes() for member, path in built_files(folder).items()}
    contents[f"{information}/METADATA"] = metadata().encode()
    contents[f"{information}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: vegard\nRoot-Is-Purelib: false\n"
                                        f"Tag: {tag()}\n").encode()
    for document in ("LICENSE", "NOTICE"):
        contents[f"{information}/{document}"] = (SOURCE / document).read_bytes()
    record = ""
    for member, data in contents.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{member},sha256={digest},{len(data)}\n"
    contents[f"{information}/RECORD"] = (record + f"{information}/RECORD,,\n").encode()
    with zipfile.ZipFile(pathlib.Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for member in sorted(contents):
            archive.writestr(member, contents[member])
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    raise RuntimeError("there is no source distribution: git archive makes one of a checkout")
