// Streamlines written by nibabel and MRtrix3, and read by them: the same points, columns and counts.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "interop/programs.h"
#include "io/tractogram.h"
#include "unit/io/image_bytes.h"

namespace radiata::io {
namespace {

using model::Tractogram;

/// Beside each file what nibabel reads from it: counts of points per streamline, then float64 points, then all columns.
constexpr const char* kScript = R"(
import glob, os, shutil, zipfile, json
import nibabel, numpy as np
from nibabel.streamlines import Tractogram, TrkFile, TckFile, Field
rng = np.random.default_rng(4)
lines = [np.cumsum(rng.normal(size=(n, 3)), axis=0).astype(np.float32) for n in (1, 2, 17, 300)]
def dump(name):
    tracts = nibabel.streamlines.load(name).tractogram
    with open(name + '.raw', 'wb') as f:
        f.write(np.array([len(s) for s in tracts.streamlines], '<i4').tobytes())
        for s in tracts.streamlines: f.write(np.asarray(s, '<f8').tobytes())
        for key in tracts.data_per_point:
            for s in tracts.data_per_point[key]: f.write(np.asarray(s, '<f8').tobytes())
        for key in tracts.data_per_streamline:
            f.write(np.asarray(tracts.data_per_streamline[key], '<f8').tobytes())
for i, order in enumerate(('RAS', 'LPS', 'LAS', 'RPI')):
    for j, matrix in enumerate((np.diag([2, 2, 2, 1.0]), np.array([[-1.5, 0.1, 0, 90], [0.1, -1.5, 0, 80], [0, 0, 3, -40], [0, 0, 0, 1]]))):
        tracts = Tractogram(lines, affine_to_rasmm=np.eye(4),
                            data_per_point={'fa': [s[:, :1] for s in lines], 'rgb': [s * 2 for s in lines]},
                            data_per_streamline={'id': np.arange(len(lines), dtype=np.float32)[:, None]})
        name = f'{order}{j}.trk'
        nibabel.streamlines.save(tracts, name, header={Field.VOXEL_TO_RASMM: matrix.astype(np.float32), Field.VOXEL_ORDER: order,
            Field.VOXEL_SIZES: np.array([2, 2, 2] if j == 0 else [1.5, 1.5, 3]), Field.DIMENSIONS: np.array([10, 20, 30])})
        dump(name)
nibabel.streamlines.save(Tractogram(lines, affine_to_rasmm=np.eye(4)), 'own.tck')
dump('own.tck')
fixtures = os.path.join(os.path.dirname(nibabel.__file__), 'tests', 'data')
for name in ('simple.tck', 'simple_big_endian.tck', 'standard.tck', 'matlab_nan.tck', 'multiline_header_field.tck',
             'simple.trk', 'complex.trk', 'complex_big_endian.trk', 'standard.trk', 'standard.LPS.trk'):
    if os.path.exists(os.path.join(fixtures, name)):
        shutil.copyfile(os.path.join(fixtures, name), 'nib_' + name)
        dump('nib_' + name)
# The same lines as a .trx file with deflated entries, as zip tools write them.
with zipfile.ZipFile('deflated.trx', 'w', zipfile.ZIP_DEFLATED) as z:
    z.writestr('header.json', json.dumps({'DIMENSIONS': [1, 1, 1], 'VOXEL_TO_RASMM': np.eye(4).tolist(), 'NB_VERTICES': 320, 'NB_STREAMLINES': 4}))
    z.writestr('positions.3.float64', np.concatenate(lines).astype('<f8').tobytes())
    z.writestr('offsets.uint64', np.array([0, 1, 3, 20, 320], '<u8').tobytes())
    z.writestr('dps/id.int16', np.arange(4, dtype='<i2').tobytes())
    z.writestr('groups/some.uint32', np.array([3, 1], '<u4').tobytes())
shutil.copyfile('own.tck.raw', 'deflated.trx.raw')
)";

/// What the script wrote, as far as `tracts` has it.
void compare(const Tractogram& tracts, const std::filesystem::path& raw, bool columns) {
    std::ostringstream text;
    text << std::ifstream(raw, std::ios::binary).rdbuf();
    const std::string bytes = text.str();
    std::size_t at = 0;
    for (std::size_t f = 0; f < tracts.fibreCount(); ++f, at += 4) {
        std::int32_t count = 0;
        std::memcpy(&count, bytes.data() + at, 4);
        ASSERT_EQ(tracts.fibre(f).size(), static_cast<std::size_t>(count)) << f;
    }
    std::vector<double> expected((bytes.size() - at) / 8);
    std::memcpy(expected.data(), bytes.data() + at, expected.size() * 8);
    ASSERT_GE(expected.size(), 3 * tracts.fibres.points.size());
    std::size_t next = 0;
    // nibabel rounds its matrix to float before it multiplies: a few steps of a float at 300 mm.
    for (const glm::vec3& p : tracts.fibres.points) {
        for (int i = 0; i < 3; ++i) ASSERT_NEAR(p[i], expected[next++], 1e-4);
    }
    if (!columns) return;
    for (const auto* all : {&tracts.fibres.vertex_values, &tracts.fibres.fibre_values}) {
        for (const auto& values : *all) {
            for (const float value : values) ASSERT_EQ(value, static_cast<float>(expected.at(next++)));
        }
    }
    EXPECT_EQ(next, expected.size());
}

TEST(TractInterop, FilesOfNibabelAreReadAsItReadsThem) {
    test::requireNibabel();
    const test::TempFolder folder;
    folder.write("write.py", kScript);
    test::run("cd '" + folder.path().string() + "' && /usr/bin/python3 -W ignore write.py");
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        if (!isTractogramName(name)) continue;
        SCOPED_TRACE(name);
        ++files;
        compare(model::readAll(*openTractogram(entry.path())), entry.path().string() + ".raw", name.ends_with(".trk"));
    }
    EXPECT_GE(files, 10);
    EXPECT_EQ(model::readAll(*openTractogram(folder.path() / "deflated.trx")).group("some").fibres,
              (std::vector<std::uint32_t>{1, 3}));
}

TEST(TractInterop, MrtrixAndNibabelReadWhatIsWritten) {
    test::requireNibabel();
    test::requireMrtrix();
    const test::TempFolder folder;
    const std::string at = "cd '" + folder.path().string() + "' && ";
    folder.write("write.py", kScript);
    test::run(at + "/usr/bin/python3 -W ignore write.py");
    const Tractogram tracts = model::readAll(*openTractogram(folder.path() / "RAS0.trk"));
    writeTractogram(*model::sourceOf(tracts), folder.path() / "out.tck");
    // MRtrix3 reads tracks and scalars together, and writes both again.
    test::run(at +
              "tckedit -quiet -force out.tck edited.tck -minlength 0 && tckinfo -count out.tck > info.txt && "
              "tsfinfo -count out_fa.tsf > tsf.txt && tsfvalidate -quiet out_fa.tsf out.tck");
    std::ostringstream info, scalars;
    info << std::ifstream(folder.path() / "info.txt").rdbuf();
    scalars << std::ifstream(folder.path() / "tsf.txt").rdbuf();
    EXPECT_NE(info.str().find("actual count in file: 4"), std::string::npos) << info.str();
    EXPECT_NE(scalars.str().find("actual count in file: 4"), std::string::npos) << scalars.str();
    const Tractogram back = model::readAll(*openTractogram(folder.path() / "edited.tck"));
    EXPECT_EQ(back.fibres.points, tracts.fibres.points);
    test::run(at +
              "/usr/bin/python3 -c \"import nibabel, numpy as np; t = nibabel.streamlines.load('out.tck').streamlines; "
              "u = nibabel.streamlines.load('RAS0.trk').streamlines; assert len(t) == 4; "
              "assert max(abs(a - b).max() for a, b in zip(t, u)) < 1e-4\"");
    // A zip file that other programs open, with arrays that can be mapped.
    writeTractogram(*model::sourceOf(tracts), folder.path() / "out.trx");
    test::run(at +
              "/usr/bin/python3 -c \"import zipfile, numpy as np; z = zipfile.ZipFile('out.trx'); assert z.testzip() is None; "
              "assert all(e.compress_type == 0 for e in z.infolist()); "
              "p = np.frombuffer(z.read('positions.3.float32'), '<f4').reshape(-1, 3); assert len(p) == 320; "
              "assert list(np.frombuffer(z.read('offsets.uint64'), '<u8')) == [0, 1, 3, 20, 320]; "
              "assert len(z.read('dpv/rgb.3.float32')) == 320 * 12\"");
}

}  // namespace
}  // namespace radiata::io
