"""Every dependency stands in docs/dependencies.md with its licence: the packages of deploy/packages, those of npm, and nothing that
is no dependency any more. Rows look like: | `name` | licence | what it is for |
"""
import json
import re

import tree

# The system itself, without which nothing could be asked of apt.
ROW = re.compile(r"^\| ((?:`[^`]+`(?:, )?)+) \| ([^|]+) \| ([^|]+) \|$")


def debian_packages():
    text = (tree.ROOT / "deploy/packages").read_text()
    names = set()
    for words in re.findall(r"^(?:run|build|test|backports)=\(([^)]*)\)", text, re.M):
        names |= set(words.split())
    names |= set(re.findall(r"missing\+=\(([a-z][a-z0-9 .+-]*)\)", text) and
                 " ".join(re.findall(r"missing\+=\(([a-z][a-z0-9 .+-]*)\)", text)).split())
    return names


def npm_packages():
    package = json.loads((tree.ROOT / "client/web/package.json").read_text())
    return set(package.get("dependencies", {})) | set(package.get("devDependencies", {}))


def main():
    rows, problems = {}, []
    for number, line in tree.lines("docs/dependencies.md"):
        found = ROW.match(line)
        if found:
            for name in re.findall(r"`([^`]+)`", found.group(1)):
                if name in rows:
                    problems.append(f"docs/dependencies.md:{number}: {name} stands in line {rows[name]} already")
                rows[name] = number
        elif line.startswith("|") and "`" in line:
            problems.append(f"docs/dependencies.md:{number}: not a row of the form | `name` | licence | what it is for |")
    wanted = debian_packages() | npm_packages()
    problems += [f"docs/dependencies.md: {name} is missing; give its licence and what it is for" for name in sorted(wanted - set(rows))]
    problems += [f"docs/dependencies.md:{rows[name]}: {name} is no dependency: nothing installs it" for name in sorted(set(rows) - wanted)]
    tree.finish(problems, (len(wanted), "dependencies"))


if __name__ == "__main__":
    main()
