"""What the lint scripts share: the tracked files of the tree, and how a broken rule is reported."""
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = {".cpp", ".h", ".glsl", ".comp", ".py", ".ts", ".mjs", ".lua", ".proto", ".cmake", ".sh", ".css", ".html"}
# Written by tools.
GENERATED = {"package-lock.json", "tests/list.txt", "LICENSE"}


def files(*folders, suffixes=None):
    """Tracked files and new ones that are not ignored, relative to the root; without a git folder, all files but build products."""
    listing = subprocess.run(["git", "-C", ROOT, "-c", f"safe.directory={ROOT}", "ls-files", "-co", "--exclude-standard", "-z"],
                             capture_output=True, text=True)
    if listing.returncode == 0:
        names = sorted(set(filter(None, listing.stdout.split("\0"))))
    else:
        skipped = {"build", "out", "node_modules", "__pycache__", ".git", ".cache", "dist", "generated"}
        names = sorted(str(path.relative_to(ROOT)) for path in ROOT.rglob("*")
                       if path.is_file() and not skipped & set(path.relative_to(ROOT).parts))
    for name in names:
        path = pathlib.PurePosixPath(name)
        inside = not folders or any(name.startswith(folder + "/") or name == folder for folder in folders)
        if inside and (suffixes is None or path.suffix in suffixes) and (ROOT / name).is_file():
            yield name


def lines(name):
    """Numbered lines of a text file; none of a binary one."""
    data = (ROOT / name).read_bytes()
    if b"\0" in data[:4096]:
        return []
    return list(enumerate(data.decode("utf-8", "replace").splitlines(), 1))


def finish(problems, checked):
    """Prints the problems and ends the script. \\p checked says what was looked at; nothing at all is a problem too."""
    for problem in problems:
        print(problem)
    if checked[0] == 0:
        print(f"0 {checked[1]} found: the rule looked at nothing")
    print(f"{checked[0]} {checked[1]}, {len(problems)} problems")
    sys.exit(bool(problems) or checked[0] == 0)
