// Writes the rectangle's word, the fragment's pixel, and a specialisation constant.
#version 460
layout(constant_id = 0) const uint kConstant = 0u;
layout(location = 0) flat in uint word;
layout(location = 0) out uvec4 words;

void main() { words = uvec4(word, uvec2(gl_FragCoord.xy), kConstant); }
