"""Writes a SPIR-V file as a C++ array: embed.py NAME INPUT.spv OUTPUT.h"""
import pathlib
import struct
import sys

name, source, target = sys.argv[1:]
data = pathlib.Path(source).read_bytes()
words = struct.unpack(f"<{len(data) // 4}I", data)
lines = [", ".join(f"0x{word:08x}" for word in words[i:i + 12]) for i in range(0, len(words), 12)]
body = ",\n    ".join(lines)
pathlib.Path(target).write_text(f"static const std::uint32_t spirv_{name}[] = {{\n    {body}}};\n")
