// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// VTK images with arrays of every format against the labels that were written.
#include <lz4.h>

#include "tests/io/volume/damaged_files.h"

namespace mw::io {
namespace {

constexpr Index3 kShape{5, 4, 3};

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    const std::size_t held = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t j = 0; j < 3; ++j) {
      bits = bits << 8U | (j < held ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      out += j <= held ? kDigits[bits >> (18 - 6 * j) & 63U] : '=';
    }
  }
  return out;
}

enum class Packing { kNone, kZlib, kLz4 };

std::string packed(const std::string& plain, Packing packing) {
  if (packing == Packing::kNone) return plain;
  if (packing == Packing::kZlib) return deflated(plain, 15);
  std::string out(plain.size() + 1000, '\0');
  const int length = LZ4_compress_default(plain.data(), out.data(), static_cast<int>(plain.size()),
                                          static_cast<int>(out.size()));
  out.resize(static_cast<std::size_t>(length));
  return out;
}

struct VtiSample {
  VoxelType type = VoxelType::kU16;
  bool big = false;
  bool long_words = false;  ///< header_type UInt64
  Packing packing = Packing::kNone;
  std::string format = "raw";  ///< "raw", "appended base64", "base64", "ascii"
  bool of_points = false;
  std::string grid = "WholeExtent=\"0 5 0 4 0 3\"";
  std::string extent = "0 5 0 4 0 3";
  std::string data_tag = " Scalars=\"labels\"";
  std::string more_arrays{};

  [[nodiscard]] std::string file(const std::vector<RawLabel>& labels) const {
    std::string body, appended, format_tag;
    if (format == "ascii") {
      format_tag = "format=\"ascii\"";
      for (const RawLabel label : labels) {
        body += (is_signed(type) ? std::to_string(static_cast<std::int64_t>(label))
                                 : std::to_string(label)) +
                "\n";
      }
    } else if (format == "base64") {
      format_tag = "format=\"binary\"";
      body = "\n  " + words(labels, true) + "\n";
    } else {
      format_tag = "format=\"appended\" offset=\"0\"";
      appended = "<AppendedData encoding=\"" + std::string(format == "raw" ? "raw" : "base64") +
                 "\">\n_" + words(labels, format != "raw") + "\n</AppendedData>";
    }
    const std::string kind = of_points ? "PointData" : "CellData";
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"" +
           std::string(big ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
           (long_words ? "UInt64" : "UInt32") + "\"" +
           (packing == Packing::kZlib  ? " compressor=\"vtkZLibDataCompressor\""
            : packing == Packing::kLz4 ? " compressor=\"vtkLZ4DataCompressor\""
                                       : "") +
           "><ImageData " + grid + "><Piece Extent=\"" + extent + "\"><" + kind + data_tag + ">" +
           more_arrays + "<DataArray type=\"" + type_name() + "\" Name=\"labels\" " + format_tag +
           ">" + body + "</DataArray></" + kind + "></Piece></ImageData>" + appended + "</VTKFile>";
  }

 private:
  [[nodiscard]] std::string type_name() const {
    return (is_signed(type) ? "Int" : "UInt") + std::to_string(8 * byte_size(type));
  }
  [[nodiscard]] std::string word(std::uint64_t value) const {
    return number_bytes(value, long_words ? 8 : 4, big);
  }
  /// Length or block table, and the bytes; base64 encodes the two apart when they are packed.
  [[nodiscard]] std::string words(const std::vector<RawLabel>& labels, bool as_text) const {
    const std::string bytes = voxel_bytes(labels, type, big);
    const auto text = [&](const std::string& part) { return as_text ? base64(part) : part; };
    if (packing == Packing::kNone) return text(word(bytes.size()) + bytes);
    constexpr std::size_t kBlock = 32;
    std::string table, blocks;
    std::size_t count = 0;
    for (std::size_t at = 0; at < bytes.size(); at += kBlock, ++count) {
      const std::string block = packed(bytes.substr(at, kBlock), packing);
      table += word(block.size());
      blocks += block;
    }
    return text(word(count) + word(kBlock) + word(bytes.size() % kBlock) + table) + text(blocks);
  }
};

TEST(Vti, EveryTypeFormatAndPacking) {
  const TempDir dir;
  for (const VoxelType type : kAllTypes) {
    const auto labels = sample_labels(kShape, type);
    for (const char* format : {"raw", "appended base64", "base64", "ascii"}) {
      for (const Packing packing : {Packing::kNone, Packing::kZlib, Packing::kLz4}) {
        for (const bool big : {false, true}) {
          const VtiSample sample{
              .type = type, .big = big, .long_words = !big, .packing = packing, .format = format};
          const auto volume = open_volume(dir.file("a.vti", sample.file(labels)));
          EXPECT_EQ(volume->info().shape, kShape);
          EXPECT_EQ(volume->info().format, "vti");
          EXPECT_EQ(read_all(*volume), labels) << name(type) << format << big;
        }
      }
    }
    expect_boxes(*open_volume(dir.file("b.vti", VtiSample{.type = type}.file(labels))), labels);
  }
}

TEST(Vti, CellsLieBetweenPointsAndPointsAreCentres) {
  const TempDir dir;
  const std::string position =
      " Origin=\"10 20 30\" Spacing=\"1 2 4\" Direction=\"0 -1 0 1 0 0 0 0 1\"";
  const VtiSample cells{.grid = "WholeExtent=\"2 7 0 4 0 3\"" + position, .extent = "2 7 0 4 0 3"};
  const auto labels = sample_labels(kShape, cells.type);
  const VolumeSpace of_cells = open_volume(dir.file("c.vti", cells.file(labels)))->info().space;
  // Axis x of the array goes along the world's y; the extent begins two steps from Origin.
  EXPECT_EQ(to_world(of_cells, {0, 0, 0}), (Vector3{10, 22, 30}));
  EXPECT_EQ(to_world(of_cells, {1, 0, 0}), (Vector3{10, 23, 30}));
  EXPECT_EQ(to_world(of_cells, {0, 1, 0}), (Vector3{8, 22, 30}));
  const VtiSample points{.of_points = true,
                         .grid =
                             "WholeExtent=\"0 4 0 3 0 2\" Origin=\"10 20 30\" "
                             "Spacing=\"1 2 4\"",
                         .extent = "0 4 0 3 0 2"};
  const auto volume = open_volume(dir.file("p.vti", points.file(labels)));
  EXPECT_EQ(volume->info().shape, kShape);
  EXPECT_EQ(read_all(*volume), labels);
  EXPECT_EQ(to_world(volume->info().space, {0.5, 0.5, 0.5}), (Vector3{10, 20, 30}));
}

TEST(Vti, TheArrayIsTheNamedOneTheScalarsOrTheOnlyIntegers) {
  const TempDir dir;
  std::string zeros = "<DataArray type=\"UInt8\" Name=\"zeros\" format=\"ascii\">";
  for (int i = 0; i < 60; ++i) zeros += "0 ";
  zeros += "</DataArray>";
  const std::string reals = "<DataArray type=\"Float32\" Name=\"reals\" format=\"ascii\"/>";
  const std::string vectors =
      "<DataArray type=\"Int8\" NumberOfComponents=\"3\" Name=\"v\" format=\"ascii\"/>";
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  const auto file = [&](const std::string& tag, const std::string& more) {
    return dir.file("a.vti", VtiSample{.data_tag = tag, .more_arrays = more}.file(labels));
  };
  EXPECT_EQ(read_all(*open_volume(file(" Scalars=\"labels\"", zeros))), labels);
  EXPECT_EQ(read_all(*open_volume(file("", reals + vectors))), labels);
  const auto two = file("", zeros + reals);
  EXPECT_EQ(read_all(*open_volume(two, {.dataset = "labels"})), labels);
  EXPECT_EQ(read_all(*open_volume(two, {.dataset = "zeros"})), std::vector<RawLabel>(60, 0));
  expect_error(ErrorKind::kInput, {"a.vti", "zeros, reals, labels", "--dataset"},
               [&] { static_cast<void>(open_volume(two)); });
  expect_error(ErrorKind::kInput, {"a.vti", "'other'", "zeros, reals, labels"},
               [&] { static_cast<void>(open_volume(two, {.dataset = "other"})); });
}

TEST(Vti, WhatIsWrongIsNamed) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  const auto refuse = [&](const std::string& content, std::vector<std::string> pieces) {
    const auto path = dir.file("a.vti", content);
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(open_volume(path)); });
  };
  const auto bend = [&](auto change, const std::vector<std::string>& pieces) {
    VtiSample sample;
    change(sample);
    refuse(sample.file(labels), pieces);
  };
  refuse("<VTKFile type=\"PolyData\"/>", {"VTKFile type", "ImageData"});
  refuse("<VTKFile type=\"ImageData\"", {"XML at offset"});
  const std::string whole = VtiSample{}.file(labels);
  refuse(whole.substr(0, whole.size() - 60), {"truncated"});
  bend([](VtiSample& s) { s.extent = "0 5 0 4 0 2"; }, {"Piece"});
  bend([](VtiSample& s) { s.grid = "WholeExtent=\"0 5\""; }, {"WholeExtent"});
  bend([](VtiSample& s) { s.grid += " Spacing=\"1 0 1\""; }, {"Spacing", "(y)", "--spacing"});
  bend([](VtiSample& s) { s.grid += " Spacing=\"1 1\""; }, {"Spacing", "3 numbers"});
  bend([](VtiSample& s) { s.grid += " Origin=\"nan 0 0\""; }, {"Origin", "--origin"});
  bend([](VtiSample& s) { s.of_points = true; }, {"labels", "120 bytes", "240"});
  bend(
      [](VtiSample& s) {
        s.grid = "WholeExtent=\"0 100000 0 100000 0 100000\"";
        s.extent = "0 100000 0 100000 0 100000";
        s.packing = Packing::kZlib;
      },
      {"labels", "not credible"});
  std::string lzma = VtiSample{.packing = Packing::kZlib}.file(labels);
  lzma.replace(lzma.find("vtkZLibData"), 11, "vtkLZMAData");
  refuse(lzma, {"vtkLZMADataCompressor", "zlib"});
}

TEST(Vti, DamagedFilesAreReadOrRefused) {
  const TempDir dir;
  const auto labels = sample_labels(kShape, VoxelType::kU16);
  for (const VtiSample& sample :
       {VtiSample{}, VtiSample{.packing = Packing::kZlib},
        VtiSample{.packing = Packing::kLz4, .format = "base64"}, VtiSample{.format = "ascii"}}) {
    damage_everywhere(dir, "a.vti", sample.file(labels), 4096, 300);
  }
}

}  // namespace
}  // namespace mw::io
