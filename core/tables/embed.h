// Tables live in the binary: the assembler reads the file (CMake passes lut/data as its include path), no header of
// numbers.
#pragma once

/// Defines `const float name[]` with the contents of lut/data/<file>, raw little-endian float32.
#define PIVOT_EMBED_TABLE(name, file)                                                                         \
    asm(".pushsection .rodata\n.balign 64\n.hidden " #name "\n.global " #name "\n" #name ":\n.incbin \"" file \
        "\"\n.popsection\n");                                                                                 \
    extern "C" const float name[];
