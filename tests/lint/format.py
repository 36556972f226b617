"""C++ is formatted by clang-format 14 as .clang-format says."""
import shutil
import subprocess
import sys

import tree


def main():
    tool = shutil.which("clang-format-14")
    if tool is None:
        sys.exit("clang-format-14 is missing; deploy/packages test installs it")
    names = [name for name in tree.files(suffixes={".cpp", ".h"})]
    problems = []
    for name in names:
        text = (tree.ROOT / name).read_bytes()
        formatted = subprocess.run([tool, f"--assume-filename={tree.ROOT / name}"], input=text, capture_output=True, check=True).stdout
        if formatted != text:
            before, after = text.splitlines(), formatted.splitlines()
            first = next((i for i, pair in enumerate(zip(before, after), 1) if pair[0] != pair[1]), min(len(before), len(after)))
            problems.append(f"{name}:{first}: not as clang-format-14 -i {name} writes it")
    tree.finish(problems, (len(names), "files"))


if __name__ == "__main__":
    main()
