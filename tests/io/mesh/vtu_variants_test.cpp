// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// .vtu files as other tools write them.
#include "io/mesh/open_mesh.h"
#include "tests/io/codec/packers.h"
#include "tests/io/mesh/sample_mesh.h"

namespace mw::io {
namespace {

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (unsigned k = 0; k < 4; ++k) {
      out += i + k < bytes.size() + 1 ? kDigits[bits >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return out;
}

/// How one file is written.
struct Style {
  bool big = false;
  int word = 4;
  bool zlib = false;
  std::string format = "ascii";  ///< or "binary", "appended", "base64" (appended)
  std::string label = "label";
};

/// Two tets of five points, labels 3 and 200.
class Writer {
 public:
  explicit Writer(const Style& style) : style_(style) {}

  std::string file() {
    std::string xml = "<?xml version=\"1.0\"?>\n<!-- made by a test -->\n";
    xml += "<VTKFile type=\"UnstructuredGrid\" byte_order=\"";
    xml += style_.big ? "BigEndian\"" : "LittleEndian\"";
    if (style_.word == 8) xml += " header_type=\"UInt64\"";
    if (style_.zlib) xml += " compressor=\"vtkZLibDataCompressor\"";
    xml += "><UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"2\"><PointData>";
    xml += array("Float32", "unused", {1, 2, 3, 4, 5}, 4);
    xml += "</PointData><CellData>" + array("UInt8", style_.label, {3, 200}, 1);
    xml += array("Float64", "quality", {0, 0}, 8) + "</CellData><Points>";
    xml += array("Float32", "", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}, -4);
    xml += "</Points><Cells>" + array("Int32", "connectivity", {0, 1, 2, 3, 1, 2, 3, 4}, 4);
    xml += array("Int64", "offsets", {4, 8}, 8) + array("UInt8", "types", {10, 10}, 1);
    xml += "</Cells></Piece></UnstructuredGrid>";
    if (!appended_.empty()) {
      xml += "<AppendedData encoding=\"";
      xml += (style_.format == "base64" ? "base64" : "raw") + std::string("\">\n   _");
      xml += appended_ + "\n</AppendedData>";
    }
    return xml + "</VTKFile>\n";
  }

 private:
  /// Size -4: Float32 x 3; sizes of floats that nobody reads do not matter.
  std::string array(const std::string& type, const std::string& name,
                    const std::vector<std::uint64_t>& numbers, int size) {
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + name + "\"";
    if (size == -4) tag += " NumberOfComponents=\"3\"";
    if (style_.format == "ascii") {
      tag += " format=\"ascii\">\n";
      for (const std::uint64_t number : numbers) tag += std::to_string(number) + "\n ";
      return tag + "</DataArray>";
    }
    std::string bytes;
    for (const std::uint64_t number : numbers) {
      std::uint64_t bits = number;
      if (size == -4) {
        const auto x = static_cast<float>(number);
        std::memcpy(&bits, &x, 4);
      }
      bytes += number_bytes(bits, std::abs(size), style_.big);
    }
    if (style_.format == "binary") {
      return tag + " format=\"binary\">\n  " + encode(bytes, true) + "\n</DataArray>";
    }
    tag += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>";
    appended_ += encode(bytes, style_.format == "base64");
    return tag;
  }

  std::string encode(const std::string& bytes, bool text) const {
    const auto word = [&](std::size_t n) { return number_bytes(n, style_.word, style_.big); };
    if (!style_.zlib) {
      const std::string all = word(bytes.size()) + bytes;
      return text ? base64(all) : all;
    }
    // Blocks of 5 bytes, so that there are several and the last may be short.
    std::string sizes;
    std::string data;
    std::size_t blocks = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 5, ++blocks) {
      const std::string packed = zlib_packed(bytes.substr(at, 5));
      sizes += word(packed.size());
      data += packed;
    }
    const std::string head = word(blocks) + word(5) + word(bytes.size() % 5) + sizes;
    return text ? base64(head) + base64(data) : head + data;
  }

  Style style_;
  std::string appended_;
};

void expect_two_tets(const MeshData& mesh) {
  ASSERT_EQ(mesh.vertices.size(), 5U);
  EXPECT_EQ(mesh.vertices[3], (Position{0, 0, 1}));
  EXPECT_EQ(mesh.tets, (std::vector<TetRows>{{0, 1, 2, 3}, {1, 2, 3, 4}}));
  EXPECT_EQ(mesh.labels, (std::vector<RawLabel>{3, 200}));
  EXPECT_FALSE(mesh.labels_signed);
}

TEST(VtuVariants, EveryEncoding) {
  const TempDir dir;
  for (const std::string format : {"ascii", "binary", "appended", "base64"}) {
    for (const bool big : {false, true}) {
      for (const int word : {4, 8}) {
        for (const bool zlib : {false, true}) {
          Style style{.big = big, .word = word, .zlib = zlib, .format = format};
          SCOPED_TRACE(format + (big ? " big" : "") + (zlib ? " zlib" : ""));
          expect_two_tets(read_mesh(dir.file("a.vtu", Writer(style).file())));
        }
      }
    }
  }
}

TEST(VtuVariants, OtherNamesOfTheLabel) {
  const TempDir dir;
  for (const std::string name : {"Label", "labels", "material", "medit:ref", "anything"}) {
    expect_two_tets(read_mesh(dir.file("a.vtu", Writer({.label = name}).file())));
  }
}

TEST(VtuVariants, RefusesWhatIsBrokenOrNoTetMesh) {
  const TempDir dir;
  const auto refuse = [&](const std::string& from, const std::string& to,
                          std::vector<std::string> pieces, const std::string& format = "ascii") {
    std::string content = Writer({.zlib = format == "appended", .format = format}).file();
    const std::size_t at = content.rfind(from);
    ASSERT_NE(at, std::string::npos) << from;
    const auto path = dir.file("a.vtu", content.replace(at, from.size(), to));
    pieces.push_back(path.string());
    expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(read_mesh(path)); });
  };
  refuse("10\n 10", "10\n 12", {"cell 1", "type 12"});
  refuse("4\n 8", "4\n 9", {"offset of cell 1"});
  refuse("3\n 4\n <", "3\n 5\n <", {"cell 1", "point 5"});
  refuse("3\n 4\n <", "3\n -1\n <", {"cell 1"});
  refuse("3\n 4\n <", "3\n <", {"connectivity", "holds 7"});
  refuse("200", "x", {"label", "'x'"});
  refuse("UInt8\" Name=\"label", "Float32\" Name=\"label", {"cell data", "0 integer arrays"});
  refuse("type=\"UnstructuredGrid\"", "type=\"PolyData\"", {"UnstructuredGrid"});
  refuse("</Piece>", "", {"XML"});
  refuse("NumberOfCells=\"2\"", "NumberOfCells=\"99999999999999999\"", {"NumberOfCells"});
  refuse("NumberOfCells=\"2\"", "NumberOfCells=\"9999999999999\"", {"types"}, "appended");
  refuse("NumberOfCells=\"2\"", "NumberOfCells=\"9999999999999\"", {"types"}, "binary");
  refuse("vtkZLib", "vtkNoSuch", {"compressor"}, "appended");
  refuse("\x78\x9c", "\x78\x9d", {"a.vtu", "zlib"}, "appended");
}

/// Every number is read whole, or the file is refused.
TEST(Vtu, NumbersThatAreNone) {
  const TempDir dir;
  for (const Style& style : {Style{}, Style{.format = "appended"}}) {
    const std::string good = Writer(style).file();
    // That of the labels; text has none.
    const std::size_t label = good.find("offset=", good.find("Name=\"label\""));
    const std::string offset =
        label == good.npos ? "offset" : good.substr(label, good.find('"', label + 8) + 1 - label);
    for (const auto& [number, changed] : std::vector<std::pair<std::string, std::string>>{
             {"NumberOfCells=\"2\"", "NumberOfCells=\"-1\""},
             {"NumberOfCells=\"2\"", "NumberOfCells=\"abc\""},
             {"NumberOfCells=\"2\"", "NumberOfCells=\"\""},
             {"NumberOfCells=\"2\"", "NumberOfCells=\"2x\""},
             {"NumberOfCells=\"2\"", "NumberOfCells=\"99999999999999999999\""},
             {"NumberOfCells=\"2\"", ""},
             {"NumberOfPoints=\"5\"", "NumberOfPoints=\"5.0\""},
             {offset, "offset=\"abc\""},
             {offset, "offset=\"-1\""}}) {
      const std::size_t at = good.find(number);
      if (at == good.npos) continue;  // no offsets in text
      std::string bad = good;
      const auto path = dir.file("a.vtu", bad.replace(at, number.size(), changed));
      expect_error(ErrorKind::kInput, {"a.vtu"}, [&] { static_cast<void>(read_mesh(path)); });
    }
    std::string padded = good;
    padded.replace(padded.find("NumberOfCells=\"2\""), 17, "NumberOfCells=\" 2 \"");
    EXPECT_EQ(read_mesh(dir.file("a.vtu", padded)).tets.size(), 2U);
  }
}

}  // namespace
}  // namespace mw::io
