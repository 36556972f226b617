"""Words that must not be in the tree: addresses of package mirrors, paths of one machine, unfinished or skipped work."""
import re

import tree

FORBIDDEN = [
    (r"https?://[^\s/\"']*(debian|ubuntu|npmjs|yarnpkg|registry|pypi|pythonhosted|mirror|crates)\b[^\s/\"']*/",
     "the address of a package mirror; take it from the machine's configuration"),
    (r"\"resolved\":", "a registry in the lock file; client/web/.npmrc leaves it out"),
    (r"(?<![\w.$}-])/(work|home/\w+|Users|mnt|root)/", "a path of one machine"),
    (r"\b(TODO|FIXME|XXX|HACK)\b", "unfinished work; finish it or leave it out"),
    (r"\bGTEST_SKIP\b|\bDISABLED_\w|\b(it|test|describe)\.(skip|todo|only)\b|unittest\.skip|skipTest|pytest\.mark\.skip",
     "a skipped test; it must run or not be there"),
    (r"\b(SUCCEED\(\)|EXPECT_TRUE\(true\)|ASSERT_TRUE\(true\))", "an empty assertion"),
    (r"(?i)\b(language model|chat ?gpt|copilot|ai[- ](assistant|generated))\b", "a word about tools, not about the project"),
    (r"(?i)(?<!known )\bissue #?\d", "a ticket's number; say what matters about it"),
]


def main():
    rules = [(re.compile(pattern), why) for pattern, why in FORBIDDEN]
    problems, count = [], 0
    for name in tree.files():
        if name in ("tests/lint/words.py", "LICENSE"):
            continue
        count += 1
        for number, line in tree.lines(name):
            for rule, why in rules:
                found = rule.search(line)
                if found:
                    problems.append(f"{name}:{number}: '{found.group(0)}': {why}")
    tree.finish(problems, (count, "files"))


if __name__ == "__main__":
    main()
