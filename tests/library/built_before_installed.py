"""All that `cmake --install` takes from the build folder is built by what tools/build builds: usage BUILD."""
import pathlib
import re
import subprocess
import sys

# there once it is configured
CONFIGURED = re.compile(r"CMakeFiles/|install_prefix.txt$|jarol-config|.*cmake_install.cmake$|made/jarol/$")


def main(build):
    build = pathlib.Path(build).resolve()
    taken = set()
    for script in build.rglob("cmake_install.cmake"):
        taken |= set(re.findall(rf'"{re.escape(str(build))}/([^"$]+)"', script.read_text()))
    taken = {path for path in taken if not CONFIGURED.match(path)}
    graph = subprocess.run(["ninja", "-C", build, "-t", "graph", "installed"], capture_output=True, text=True, check=True)
    made = set(re.findall(r'\[label="([^"]+)"', graph.stdout))
    # a step that makes a whole folder leaves a stamp there, or its files are known one by one
    folders = {str(parent) for file in made for parent in pathlib.PurePath(file).parents}
    missing = sorted(path for path in taken if path not in made and path.rstrip("/") not in folders
                     and f"{pathlib.PurePath(path).parent}/stamp" not in made)
    for path in missing:
        print(f"{path} is installed, and 'installed' does not build it")
    print(f"{len(taken)} files and folders are installed, {len(missing)} of them not built")
    return 1 if missing or len(taken) < 12 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
