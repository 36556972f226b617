// Files written by nibabel are read with the numbers and the matrix that nibabel itself reads from them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "interop/programs.h"
#include "io/volume.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

/// Writes images into the current folder, and beside each what nibabel reads from it: the matrix by rows and all samples with
/// the first axis fastest, as float64.
constexpr const char* kScript = R"(
import nibabel, numpy as np
c, s = np.cos(0.3), np.sin(0.3)
turn = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
matrices = {
    'plain': np.array([[2, 0, 0, -10], [0, 2, 0, 5], [0, 0, 3, 1], [0, 0, 0, 1.0]]),
    'flipped': np.array([[-2, 0, 0, 10], [0, 2, 0, 5], [0, 0, 3, 1], [0, 0, 0, 1.0]]),
    'oblique': np.vstack([np.hstack([turn @ np.diag([1.5, 2, 2.5]), [[3], [-40], [7]]]), [0, 0, 0, 1.0]]),
}
rng = np.random.default_rng(18)
floats = rng.normal(size=(5, 4, 3, 6)) * 3
whole = rng.integers(0, 101, size=(5, 4, 3, 6))
def save(name, image):
    nibabel.save(image, name)
    back = nibabel.load(name)
    with open(name + '.raw', 'wb') as f:
        f.write(back.affine.astype('<f8').tobytes())
        f.write(np.asarray(back.dataobj).astype('<f8').tobytes(order='F'))
for version, kind in ((1, nibabel.Nifti1Image), (2, nibabel.Nifti2Image)):
    for order in '<>':
        for matrix_name, matrix in matrices.items():
            for forms in ('sform', 'qform', 'both'):
                header = kind.header_class(endianness=order)
                header.set_data_dtype(np.float32)
                image = kind(floats.astype(np.float32), matrix, header)
                image.set_sform(matrix, code=0 if forms == 'qform' else 1)
                image.set_qform(matrix, code=0 if forms == 'sform' else 1)
                save(f'v{version}_{"b" if order == ">" else "l"}_{matrix_name}_{forms}.nii', image)
        for dtype in ('int8', 'uint8', 'int16', 'uint16', 'int32', 'uint32', 'int64', 'uint64', 'float32', 'float64'):
            header = kind.header_class(endianness=order)
            header.set_data_dtype(np.dtype(dtype).newbyteorder(order))
            image = kind(whole.astype(dtype), matrices['oblique'], header)
            save(f'v{version}_{"b" if order == ">" else "l"}_{dtype}.nii.gz', image)
        for dtype in ('int16', 'uint8', 'int32'):
            header = kind.header_class(endianness=order)
            header.set_data_dtype(np.dtype(dtype).newbyteorder(order))
            image = kind(floats, matrices['flipped'], header)
            save(f'v{version}_{"b" if order == ">" else "l"}_scaled_{dtype}.nii', image)
        image = kind(floats.astype(np.float32), matrices['plain'])
        image.header['pixdim'][4] = np.nan
        save(f'v{version}_{"b" if order == ">" else "l"}_nan_pixdim.nii.gz', image)
)";

TEST(NibabelInterop, EveryFileIsReadAsNibabelReadsIt) {
    // Samples: one rounding to float32 (2^-24 relative, twice for scaled ones). Matrix: 1e-6, the quaternion is stored in
    // float32.
    test::requireNibabel();
    const test::TempFolder folder;
    folder.write("write.py", kScript);
    test::run("cd '" + folder.path().string() + "' && /usr/bin/python3 write.py");
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        if (!name.ends_with(".nii") && !name.ends_with(".nii.gz")) continue;
        SCOPED_TRACE(name);
        ++files;
        const Volume volume = readVolume(entry.path());
        ASSERT_EQ(volume.size, (std::array<std::int64_t, 4>{5, 4, 3, 6}));
        std::ostringstream text;
        text << std::ifstream(entry.path().string() + ".raw", std::ios::binary).rdbuf();
        const std::string bytes = text.str();
        std::vector<double> expected(16 + 360);
        ASSERT_EQ(bytes.size(), expected.size() * sizeof(double));
        std::memcpy(expected.data(), bytes.data(), bytes.size());
        for (int r = 0; r < 4; ++r) {
            for (int c = 0; c < 4; ++c) {
                EXPECT_NEAR(volume.voxel_to_world[c][r], expected[static_cast<std::size_t>(4 * r + c)], 1e-6) << r << ' ' << c;
            }
        }
        for (std::size_t i = 0; i < 360; ++i) {
            const double value = expected[16 + i];
            ASSERT_NEAR(volume.data[i], value, std::abs(value) * std::ldexp(1.0, -23)) << i;
        }
    }
    EXPECT_EQ(files, 2 * 2 * (9 + 10 + 3 + 1));
}

}  // namespace
}  // namespace radiata::io
