# The list of all shader modules.
radiata_shader(test_square test/square.comp)
radiata_shader(test_shading test/shading.comp)
foreach(k 2 4 6 8 10 12)
    radiata_shader(test_polynomial_even${k} test/polynomial.comp even${k})
endforeach()
