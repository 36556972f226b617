"""Holds the tests that a build knows against tests/list.txt: test_list.py BUILD_FOLDER [--update]

So no test gets lost, through a condition in a CMake file for example, without anybody noticing.
"""
import re
import subprocess
import sys

import tree

LIST = tree.ROOT / "tests" / "list.txt"


def known(build):
    out = subprocess.run(["ctest", "--test-dir", build, "-N"], capture_output=True, text=True, check=True).stdout
    names = re.findall(r"^\s*Test\s+#\d+: (.+)$", out, re.M)
    if not names:
        sys.exit(f"the build in {build} knows no test: {out}")
    return sorted(names)


def main():
    names = known(sys.argv[1])
    if sys.argv[2:] == ["--update"]:
        LIST.write_text("\n".join(names) + "\n")
        print(f"{len(names)} tests in {LIST}")
        return
    listed = LIST.read_text().split("\n")[:-1] if LIST.exists() else []
    problems = [f"missing: {name}" for name in sorted(set(listed) - set(names))]
    problems += [f"not in the list: {name}" for name in sorted(set(names) - set(listed))]
    problems += [f"twice: {name}" for name in sorted(set(names)) if names.count(name) > 1]
    if problems:
        problems.append("if this is as it should be, write the list anew: tests/run --update-list, and commit tests/list.txt")
    tree.finish(problems, (len(names), "tests"))


if __name__ == "__main__":
    main()
