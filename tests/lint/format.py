"""C++ is formatted by clang-format 14 as .clang-format says."""
import re
import shutil
import subprocess
import sys

import tree


def main():
    tool = shutil.which("clang-format-14")
    if tool is None:
        sys.exit("clang-format-14 is missing; deploy/packages test installs it")
    names = list(tree.files(suffixes={".cpp", ".h"}))
    done = subprocess.run([tool, "--dry-run", *names], cwd=tree.ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    first = {}
    for name, line in re.findall(r"^(\S+?):(\d+):\d+: warning: code should be clang-formatted", done.stderr, re.M):
        first.setdefault(name, line)
    tree.finish([f"{name}:{line}: not as clang-format-14 -i {name} writes it" for name, line in first.items()], (len(names), "files"))


if __name__ == "__main__":
    main()
