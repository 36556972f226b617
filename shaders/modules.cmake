# The list of all shader modules.
radiata_shader(test_square test/square.comp)
