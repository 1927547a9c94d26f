// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// .vtkhdf files as other tools write them, and what ours hold.
#include <sys/stat.h>
#include <zlib.h>

#include <functional>

#include "io/hdf5/hdf5_file.h"
#include "io/mesh/apart_mesh.h"
#include "io/mesh/open_mesh.h"
#include "tests/io/mesh/sample_mesh.h"
#include "tests/io/mesh/written_mesh.h"

namespace mw::io {
namespace {

/// How numbers are stored.
struct Array {
  std::vector<std::int64_t> numbers;
  hid_t type = H5T_STD_I64LE;
  hsize_t components = 1;
};

/// Two tets of five points each, labels 3 and 200, in two partitions; changed at will by tests.
struct Sample {
  std::string type = "UnstructuredGrid";
  bool deflated = false;
  std::map<std::string, Array> arrays{
      {"NumberOfPoints", {{4, 5}}},
      {"NumberOfCells", {{1, 2}}},
      {"NumberOfConnectivityIds", {{4, 8}}},
      {"Points",
       {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 5, 0, 0, 6, 0, 0, 5, 1, 0, 5, 0, 1, 6, 1, 1},
        H5T_IEEE_F32LE,
        3}},
      {"Connectivity", {{0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3, 4}}},
      {"Offsets", {{0, 4, 0, 4, 8}}},
      {"Types", {{10, 10, 10}, H5T_STD_U8LE}},
      {"CellData/label", {{3, 200, 7}, H5T_STD_U16BE}},
      {"CellData/quality", {{0, 0, 0}, H5T_IEEE_F64LE}}};
};

void write_array(hid_t group, const std::string& name, const Array& array, bool deflated) {
  const std::array<hsize_t, 2> size{array.numbers.size() / array.components, array.components};
  const int rank = array.components == 1 ? 1 : 2;
  const Hdf5Handle space(H5Screate_simple(rank, size.data(), nullptr), &H5Sclose);
  const Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
  if (deflated) {
    H5Pset_chunk(properties.get(), rank, size.data());
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), 1);
  }
  const Hdf5Handle set(H5Dcreate2(group, name.c_str(), array.type, space.get(), H5P_DEFAULT,
                                  properties.get(), H5P_DEFAULT),
                       &H5Dclose);
  EXPECT_GE(
      H5Dwrite(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, array.numbers.data()),
      0);
}

std::filesystem::path write_file(const TempDir& dir, const Sample& sample) {
  auto path = dir.path() / "other.vtkhdf";
  const Hdf5Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                        &H5Fclose);
  const Hdf5Handle group(H5Gcreate2(file.get(), "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         &H5Gclose);
  const Hdf5Handle cells(H5Gcreate2(group.get(), "CellData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         &H5Gclose);
  const Hdf5Handle string(H5Tcopy(H5T_C_S1), &H5Tclose);
  H5Tset_size(string.get(), sample.type.size());
  const Hdf5Handle scalar(H5Screate(H5S_SCALAR), &H5Sclose);
  const Hdf5Handle type(
      H5Acreate2(group.get(), "Type", string.get(), scalar.get(), H5P_DEFAULT, H5P_DEFAULT),
      &H5Aclose);
  H5Awrite(type.get(), string.get(), sample.type.data());
  for (const auto& [name, array] : sample.arrays) {
    write_array(group.get(), name, array, sample.deflated);
  }
  return path;
}

TEST(VtkhdfVariants, PartitionsTypesAndFilters) {
  const TempDir dir;
  for (const bool deflated : {false, true}) {
    for (const hid_t real : {H5T_IEEE_F32LE, H5T_IEEE_F64BE}) {
      for (const hid_t index : {H5T_STD_I32LE, H5T_STD_I64BE, H5T_STD_U64LE}) {
        Sample sample;
        sample.deflated = deflated;
        sample.arrays["Points"].type = real;
        for (const char* name : {"Connectivity", "Offsets", "NumberOfCells"}) {
          sample.arrays[name].type = index;
        }
        const MeshData mesh = read_mesh(write_file(dir, sample));
        ASSERT_EQ(mesh.vertices.size(), 9U);
        EXPECT_EQ(mesh.vertices[8], (Position{6, 1, 1}));
        EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}, {4, 5, 6, 7}, {5, 6, 7, 8}}));
        EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{3, 200, 7}));
        EXPECT_FALSE(mesh.labels_signed);
      }
    }
  }
}

TEST(VtkhdfVariants, SignedAndOtherwiseNamedLabels) {
  const TempDir dir;
  for (const std::string name : {"Label", "labels", "material", "anything"}) {
    Sample sample;
    sample.arrays.erase("CellData/label");
    sample.arrays["CellData/" + name] = {{-3, 2, 7}, H5T_STD_I8LE};
    const MeshData mesh = read_mesh(write_file(dir, sample));
    EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{static_cast<RawLabel>(-3), 2, 7})) << name;
    EXPECT_TRUE(mesh.labels_signed);
  }
}

/// A crafted file could bring in what other files of the user hold, or wait for a pipe for ever.
TEST(VtkhdfVariants, NumbersInOtherFilesAreNotRead) {
  const TempDir dir;
  const std::filesystem::path pipe = dir.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const hsize_t rows = 3, endless = H5S_UNLIMITED;
  const Hdf5Handle space(H5Screate_simple(1, &rows, nullptr), &H5Sclose);
  const Hdf5Handle growing(H5Screate_simple(1, &rows, &endless), &H5Sclose);
  const auto make = [&](const auto& set_up, hid_t extent) {
    return [&, extent](hid_t cells) {
      const Hdf5Handle storage(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose);
      set_up(storage.get());
      const Hdf5Handle set(
          H5Dcreate2(cells, "label", H5T_STD_U8LE, extent, H5P_DEFAULT, storage.get(), H5P_DEFAULT),
          &H5Dclose);
      EXPECT_TRUE(set.valid());
    };
  };
  const auto refuse = [&](const char* reason, const std::function<void(hid_t)>& add_label) {
    Sample sample;
    sample.arrays.erase("CellData/label");
    const auto path = write_file(dir, sample);
    {
      const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose);
      const Hdf5Handle cells(H5Gopen2(file.get(), "/VTKHDF/CellData", H5P_DEFAULT), &H5Gclose);
      add_label(cells.get());
    }
    expect_error(ErrorKind::kInput, {path.string(), "CellData/label", reason},
                 [&] { static_cast<void>(read_mesh(path)); });
  };
  refuse("external storage",
         make([&](hid_t list) { H5Pset_external(list, pipe.c_str(), 0, rows); }, space.get()));
  refuse(
      "virtual",
      make([&](hid_t list) { H5Pset_virtual(list, space.get(), pipe.c_str(), "/a", space.get()); },
           space.get()));
  refuse("a link leads to another file", [&](hid_t cells) {
    H5Lcreate_external(pipe.c_str(), "/a", cells, "label", H5P_DEFAULT, H5P_DEFAULT);
  });
  refuse("virtual", make(
                        [&](hid_t list) {
                          const Hdf5Handle all(H5Scopy(growing.get()), &H5Sclose);
                          const hsize_t start = 0, count = H5S_UNLIMITED;
                          H5Sselect_hyperslab(all.get(), H5S_SELECT_SET, &start, nullptr, &count,
                                              nullptr);
                          H5Pset_virtual(list, all.get(), pipe.c_str(), "/a", all.get());
                        },
                        growing.get()));
}

TEST(VtkhdfVariants, RefusesWhatIsBrokenOrNoTetMesh) {
  const TempDir dir;
  const auto refuse = [&](std::vector<std::string> pieces, auto change) {
    Sample sample;
    change(sample);
    const auto path = write_file(dir, sample);
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  };
  const auto set = [](const char* array, std::size_t at, std::int64_t number) {
    return [=](Sample& sample) { sample.arrays[array].numbers[at] = number; };
  };
  refuse({"type 12"}, set("Types", 2, 12));
  refuse({"Offsets", "9 is not 8"}, set("Offsets", 4, 9));
  refuse({"Connectivity", "point 5, there are 5"}, set("Connectivity", 11, 5));
  refuse({"Connectivity", "point 4, there are 4"}, set("Connectivity", 0, 4));
  refuse({"Connectivity", "point -1"}, set("Connectivity", 7, -1));
  refuse({"label", "has 4 rows, there are 3 cells"},
         [](Sample& s) { s.arrays["CellData/label"].numbers.push_back(5); });
  refuse({"label", "has 2 rows, there are 3 cells"},
         [](Sample& s) { s.arrays["CellData/label"].numbers.pop_back(); });
  refuse({"Types", "3 rows"}, set("NumberOfCells", 1, 3));
  refuse({"Points", "9 rows"}, set("NumberOfPoints", 1, 6));
  refuse({"not credible"}, set("NumberOfCells", 1, std::int64_t{1} << 60));
  refuse({"Type", "PolyData"}, [](Sample& s) { s.type = "PolyData"; });
  for (const char* name : {"Points", "Types", "Offsets", "Connectivity", "NumberOfCells"}) {
    refuse({name, "missing"}, [&](Sample& s) { s.arrays.erase(name); });
  }
  refuse({"cell data", "0 integer arrays"},
         [](Sample& s) { s.arrays["CellData/label"].type = H5T_IEEE_F64LE; });
  refuse({"Points", "3 components"}, [](Sample& s) { s.arrays["Points"].components = 1; });
  refuse({"partitions"}, [](Sample& s) { s.arrays["NumberOfPoints"].numbers.push_back(0); });
  expect_error(ErrorKind::kInput, {"text.vtkhdf", "no HDF5 file"},
               [&] { static_cast<void>(read_mesh(dir.file("text.vtkhdf", "hello"))); });
  expect_error(ErrorKind::kInput, {"gone.vtkhdf"},
               [] { static_cast<void>(read_mesh("gone.vtkhdf")); });
}

/// The HDF5 library reads what lies in memory behind a chunk that unpacks to too few bytes.
TEST(Vtkhdf, ShortChunksAreRefused) {
  for (const char* name : {"Points", "Connectivity", "CellData/label", "NumberOfCells"}) {
    const TempDir dir;
    Sample sample;
    sample.deflated = true;
    const auto path = write_file(dir, sample);
    EXPECT_EQ(read_mesh(path).tets.size(), 3U);
    {
      const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), &H5Fclose);
      const Hdf5Handle set(
          H5Dopen2(file.get(), (std::string("VTKHDF/") + name).c_str(), H5P_DEFAULT), &H5Dclose);
      const std::array<Bytef, 1> one{};
      std::array<Bytef, 64> packed{};
      uLongf size = packed.size();
      EXPECT_EQ(compress(packed.data(), &size, one.data(), one.size()), Z_OK);
      const std::array<hsize_t, 2> first{};
      EXPECT_GE(H5Dwrite_chunk(set.get(), H5P_DEFAULT, 0, first.data(), size, packed.data()), 0);
    }
    expect_error(ErrorKind::kInput, {name, "holds 1 bytes"},
                 [&] { static_cast<void>(read_mesh(path)); });
  }
}

/// Version, type and counts as VTK 9.1 asks for them.
TEST(Vtkhdf, FileIsVersionOneOfOnePartition) {
  const TempDir dir;
  const auto path = dir.path() / "m.vtkhdf";
  write_mesh(sample_mesh(7, false), *open_mesh_sink(path));
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose);
  const Hdf5Handle version(
      H5Aopen_by_name(file.get(), "VTKHDF", "Version", H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  std::array<int, 2> numbers{};
  EXPECT_GE(H5Aread(version.get(), H5T_NATIVE_INT, numbers.data()), 0);
  EXPECT_EQ(numbers, (std::array<int, 2>{1, 0}));
  const std::map<std::string, std::int64_t> counts{
      {"NumberOfPoints", 10}, {"NumberOfCells", 7}, {"NumberOfConnectivityIds", 28}};
  for (const auto& [name, expected] : counts) {
    const Hdf5Handle set(H5Dopen2(file.get(), ("VTKHDF/" + name).c_str(), H5P_DEFAULT), &H5Dclose);
    std::int64_t count = 0;
    EXPECT_EQ(H5Dget_storage_size(set.get()), sizeof count);
    EXPECT_GE(H5Dread(set.get(), H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &count), 0);
    EXPECT_EQ(count, expected) << name;
  }
  H5O_info_t info{};
  for (const char* name : {"VTKHDF", "VTKHDF/Points", "VTKHDF/CellData/label"}) {
    EXPECT_GE(H5Oget_info_by_name1(file.get(), name, &info, H5P_DEFAULT), 0);
    EXPECT_TRUE(info.mtime == 0 && info.ctime == 0 && info.btime == 0) << name;
  }
}

// Damaged .vtkhdf meshes are errors; the HDF5 library crashes on some of them.

/// Eight bytes of ones at every step of a file; returns how many of these were refused.
int refused_of(const MeshData& mesh, Element element, std::size_t step) {
  const TempDir dir;
  const auto path = dir.path() / "good.vtkhdf";
  save(mesh, path, element);
  const std::string good = content_of(path);
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); at += step) {
    std::string bad = good;
    for (std::size_t i = at; i < std::min(at + 8, good.size()); ++i) bad[i] = '\xff';
    try_mesh(dir.file("bad.vtkhdf", bad), at, refused);
  }
  return refused;
}

TEST(VtkhdfDamage, EightBytesOfOnesAnywhere) {
  EXPECT_GT(refused_of(sample_mesh(7, false), Element::kTet4, 8), 100);
  EXPECT_GT(refused_of(grid_mesh({2, 1, 1}, 1), Element::kTet10, 72), 20);
}

TEST(VtuDamage, OfTenNodes) {
  const TempDir dir;
  save(grid_mesh({2, 1, 1}, 1), dir.path() / "m.vtu", Element::kTet10);
  EXPECT_GT(try_damage(dir, "m.vtu", content_of(dir.path() / "m.vtu")), 30);
}

/// What a reader that broke could send.
TEST(ApartMesh, NoRowIsTakenOnTrust) {
  const std::vector<Position> points(4, Position{0, 0, 0});
  const std::vector<TetRows> tets{{0, 1, 2, 4}};
  const std::vector<RawLabel> labels{1};
  const auto pass = [](const std::function<void(MeshSink&)>& read) {
    MeshDataSink out;
    return pass_mesh_apart({}, read, out);
  };
  EXPECT_NE(pass([](MeshSink&) {}), "");
  EXPECT_NE(pass([](MeshSink& sink) { sink.begin({}); }), "");
  EXPECT_NE(pass([&](MeshSink& sink) { sink.write_vertices(points), sink.finish(); }), "");
  const auto read = [&](std::span<const Position> vertices) {
    return [&, vertices](MeshSink& sink) {
      sink.begin({.tets = 1});
      sink.write_vertices(vertices);
      sink.write_tets(tets, labels);
      sink.finish();
    };
  };
  EXPECT_NE(pass(read(points)), "");
  const std::vector<Position> enough(5, Position{0, 0, 0});
  EXPECT_EQ(pass(read(enough)), "");
  const std::vector<Position> too_many(kMaxApartRows + 1, Position{0, 0, 0});
  EXPECT_NE(pass(read(too_many)), "");
}

/// An error of the one that receives ends the child.
TEST(ApartMesh, ErrorsOfTheSinkPass) {
  class FullDisk : public MeshDataSink {
    void write_vertices(std::span<const Position>) override {
      throw Error(ErrorKind::kResource, "disk full");
    }
  };
  FullDisk out;
  const std::vector<Position> points(4, Position{0, 0, 0});
  expect_error(ErrorKind::kResource, {"disk full"}, [&] {
    static_cast<void>(pass_mesh_apart(
        {},
        [&](MeshSink& sink) {
          sink.begin({});
          while (true) sink.write_vertices(points);
        },
        out));
  });
}

}  // namespace
}  // namespace mw::io
