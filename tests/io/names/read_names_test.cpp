// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Tables of names: each kind, random ones written and read back, and broken ones.
#include <nlohmann/json.hpp>

#include "io/names/label_names.h"
#include "io/names/read_names.h"
#include "tests/io/names/random_names.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

LabelNames parse(const std::string& text) {
  return parse_names(text, "table");
}

TEST(ReadNames, ItkSnap) {
  const LabelNames names = parse(
      "################################################\n# ITK-SnAP Label Description File\n"
      "# IDX   -R-  -G-  -B-  -A--  VIS MSH  LABEL\n"
      "    0     0    0    0        0  0  0    \"Clear Label\"\r\n"
      "    1   255    0    0        1  1  1    \"Left \"big\" one, really\"\r\n"
      "    2     0  255    0      0.5  1  0    \"\"\n");
  expect_same_names(names, LabelNames({{0, "Clear Label", {}},
                                       {1, "Left \"big\" one, really", Colour{255, 0, 0, 255}},
                                       {2, "", Colour{0, 255, 0, 128}}}));
}

TEST(ReadNames, JsonOfEitherDirection) {
  const LabelNames expected({{0, "background", {}}, {1, "liver", {}}, {12, "vessel, left", {}}});
  for (const std::string text : {
           R"({"channel_names": {"0": "CT"}, "labels": {"background": 0, "liver": 1,
               "vessel, left": 12}, "numTraining": 3, "file_ending": ".nii.gz"})",
           R"( {"modality": {"0": "CT"}, "labels": {"0": "background", "1": "liver",
               "12": "vessel, left"}})",
           R"({"labels": {"background": 0, "whole": [1, 12], "liver": [1], "vessel, left": "12"}})",
           R"({"0": "background", "1": "liver", "12": "vessel, left"})",
           R"({"total": {"0": "background", "1": "liver", "12": "vessel, left"}, "body": {}})",
           "\xEF\xBB\xBF{\"background\": 0, \"liver\": 1, \"vessel, left\": 12}"}) {
    expect_same_names(parse(text), expected);
  }
  expect_same_names(parse(R"({"a": -3, "b": 18446744073709551615})"),
                    LabelNames({{static_cast<RawLabel>(-3), "a", {}}, {~RawLabel{0}, "b", {}}}));
}

TEST(ReadNames, JsonThatNamesNoLabelOrOneTwiceIsRefused) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"{", "table"},
      {"{}", "names no label"},
      {R"({"labels": {"whole": [1, 2]}, "other": {"a": 1}})", "names no label"},
      {R"({"labels": {"a": 1, "b": 1}})", "'a' and 'b' are one label"},
      {R"({"labels": {"1": "a", "2": "a"}})", "have one name"},
      {R"({"total": {"1": "a"}, "body": {"1": "b"}})", "class_map"},
      {R"({"1": {"2": {"3": 4.5}}})", "names no label"}};
  for (const auto& [text, words] : cases) {
    expect_error(ErrorKind::kInput, {"table", words}, [&] { static_cast<void>(parse(text)); });
  }
}

TEST(ReadNames, Latin1IsToldAndRead) {
  for (const std::string table : {"id,name\n7,Gr\xF6\xDF"
                                  "e\n8,\xE9t\xE9\n",
                                  "7 255 0 0 1 1 1 \"Gr\xF6\xDF"
                                  "e\"\n8 0 9 0 1 1 1 \"\xE9t\xE9\"\n"}) {
    std::string note;
    const LabelNames names = parse_names(table, "table", &note);
    EXPECT_EQ(names.name(7),
              "Gr\xC3\xB6\xC3\x9F"
              "e");
    EXPECT_EQ(names.name(8), "\xC3\xA9t\xC3\xA9");
    EXPECT_NE(note.find("Latin-1"), std::string::npos) << note;
  }
  std::string note;
  EXPECT_EQ(parse_names("id,name\n7,Gr\xC3\xB6\xC3\x9F"
                        "e\n",
                        "table", &note)
                .name(7),
            "Gr\xC3\xB6\xC3\x9F"
            "e");
  EXPECT_EQ(note, "");
}

TEST(ReadNames, FreeSurferIsOpaqueWhereAllOpacityIsZero) {
  const LabelNames names = parse(
      "#$Id: FreeSurferColorLUT.txt\n\n#No. Label Name:        R   G   B   A\n\n"
      "0   Unknown                                 0   0   0   0\n"
      "2   Left-Cerebral-White-Matter              245 245 245 0\n"
      "17\tLeft_Hippocampus\t220\t216\t20\t0\n");
  expect_same_names(names,
                    LabelNames({{0, "Unknown", Colour{0, 0, 0, 255}},
                                {2, "Left-Cerebral-White-Matter", Colour{245, 245, 245, 255}},
                                {17, "Left_Hippocampus", Colour{220, 216, 20, 255}}}));
}

TEST(ReadNames, FreeSurfer8HasClassesOfTissues) {
  expect_same_names(parse("#No. Label Name: R G B A\n0 Unknown 0 0 0 0\n"
                          "819 Left-HypoThal-noMB           0  80   0 0 2\n"
                          "853 Mid-AntCom                  60  58 210 0 3\n7 Lobe 3 10 20 30 0\n"),
                    LabelNames({{0, "Unknown", Colour{0, 0, 0, 255}},
                                {7, "Lobe 3", Colour{10, 20, 30, 255}},
                                {819, "Left-HypoThal-noMB", Colour{0, 80, 0, 255}},
                                {853, "Mid-AntCom", Colour{60, 58, 210, 255}}}));
}

TEST(ReadNames, FreeSurferCountsTransparency) {
  const LabelNames names =
      parse("0 Unknown 0 0 0 0\n1 Left-Lobe 221 130 101 0\n2 ctx 1 2 3 0\n3 Vent 4 5 6 128\n");
  expect_same_names(names, LabelNames({{0, "Unknown", Colour{0, 0, 0, 255}},
                                       {1, "Left-Lobe", Colour{221, 130, 101, 255}},
                                       {2, "ctx", Colour{1, 2, 3, 255}},
                                       {3, "Vent", Colour{4, 5, 6, 127}}}));
}

TEST(ReadNames, SlicerCountsOpacityAlsoWhereMostIsHidden) {
  const std::string rows = "0 bg 0 0 0 0\n1 a 1 2 3 0\n2 b 1 2 3 0\n3 c 4 5 6 255\n";
  const LabelNames expected({{0, "bg", {}},
                             {1, "a", Colour{1, 2, 3, 0}},
                             {2, "b", Colour{1, 2, 3, 0}},
                             {3, "c", Colour{4, 5, 6, 255}}});
  expect_same_names(parse("# Color table file x.ctbl\n# 4 values\n" + rows), expected);
  expect_same_names(parse_names(rows, "a/b.CTBL"), expected);
  expect_same_names(parse_names(rows, "b.ctbl.gz"), expected);
  EXPECT_EQ(parse(rows).find(1)->colour, (Colour{1, 2, 3, 255}));
}

TEST(ReadNames, SlicerKeepsOpacity) {
  const LabelNames names = parse(
      "# Color table file /x/y.ctbl\n# 3 values\n0 Background 0 0 0 0\n1 tissue_1 128 174 128 255\n"
      "-5 two words 1 2 3 40\n6 plain 7 8 9\n8 bare\n");
  expect_same_names(names,
                    LabelNames({{0, "Background", {}},
                                {1, "tissue_1", Colour{128, 174, 128, 255}},
                                {static_cast<RawLabel>(-5), "two words", Colour{1, 2, 3, 40}},
                                {6, "plain", Colour{7, 8, 9, 255}},
                                {8, "bare", {}}}));
}

TEST(ReadNames, CodesBehindNamesAreSkipped) {
  expect_same_names(parse("1 Precentral_L 2001\n2 Precentral_R 2002\n"),
                    LabelNames({{1, "Precentral_L", {}}, {2, "Precentral_R", {}}}));
}

TEST(ReadNames, CsvByItsHeader) {
  const LabelNames expected({{1, "liver, left", Colour{255, 128, 0, 255}}, {22, "b", {}}});
  expect_same_names(parse("\xEF\xBB\xBFLabel,Name,R,G,B\n1,\"liver, left\",255,128,0\n22,b,,,\n"),
                    expected);
  expect_same_names(parse("name;junk;ID;colour\n liver, left ;x;1;#ff8000\nb;;22;\n"), expected);
  expect_same_names(parse("index\tname\tcolor\r\n1\tliver, left\tFF8000FF\r\n22\tb\t\r\n"),
                    expected);
  expect_same_names(parse("# comment, here\nid,label,red,green,blue,alpha\n"
                          "1,\"liver, left\",1.0,0.5,0.0,1.0\n\n22.0,b\n"),
                    expected);
  expect_same_names(parse("LabelValue,Structure,Color_R,Color_G,Color_B\n"
                          "1,\"liver, left\",255,128,0\n22,b\n"),
                    expected);
  expect_same_names(parse("id,rgb,hex\n3,,#010203\n"), LabelNames({{3, "", Colour{1, 2, 3, 255}}}));
}

TEST(ReadNames, CsvWithoutHeader) {
  expect_same_names(parse("18446744073709551615,big\n7,\"a \"\"b\"\"\nc\",9\n"),
                    LabelNames({{7, "a \"b\" c", {}}, {~RawLabel{0}, "big", {}}}));
}

/// Writers of the test's own, names quoted as each format has it.
std::string csv_field(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string csv_table(const LabelNames& names, char separator) {
  const std::string s(1, separator);
  std::string out = "id" + s + "name" + s + "r" + s + "g" + s + "b" + s + "a\n";
  for (const LabelName& row : names.rows()) {
    out += std::to_string(row.label) + s + csv_field(row.name);
    for (std::size_t i = 0; i < 4; ++i) {
      out += s + (row.colour ? std::to_string((*row.colour)[i]) : "");
    }
    out += "\n";
  }
  return out;
}

TEST(ReadNames, RandomTablesAreReadBack) {
  std::mt19937 random(41);
  for (int i = 0; i < 300; ++i) {
    const LabelNames names = random_names(random, 1 + below(random, 20));
    if (names.empty()) continue;
    for (const char separator : {',', ';', '\t'}) {
      expect_same_names(parse(csv_table(names, separator)), names);
    }
    std::string snap;
    for (const LabelName& row : names.rows()) {
      const Colour c = row.colour.value_or(Colour{});
      snap += std::to_string(row.label) + " " + std::to_string(c[0]) + " " + std::to_string(c[1]) +
              " " + std::to_string(c[2]) + " " + std::to_string(c[3] / 255.0) + " 1 1 \"" +
              row.name + "\"\n";
    }
    expect_same_names(parse(snap), names);
  }
}

TEST(ReadNames, FilesMayBeGzipped) {
  const TempDir dir;
  const auto path = dir.file("names.csv.gz", gzip("id,name\n7,liver\n"));
  EXPECT_EQ(read_names(path).name(7), "liver");
}

void expect_refused(const std::string& text, std::vector<std::string> pieces) {
  pieces.push_back("table");
  expect_error(ErrorKind::kInput, pieces, [&] { static_cast<void>(parse(text)); });
}

TEST(ReadNames, BadLinesAreNamed) {
  expect_refused("", {"names no label"});
  expect_refused("# nothing\n\n", {"names no label"});
  expect_refused("some text\n", {"line 1", "ID NAME R G B A"});
  expect_refused("1 a 0 0 0 255\n\n# c\n2 b 0 0 256 255\n", {"line 4", "0 to 255"});
  expect_refused("1 a 0 0 0 255\nx b 0 0 0 255\n", {"line 2"});
  expect_refused("1 255 0 0 1 1 1 \"a\"\n2 255 0 0 7 1 1 \"b\"\n", {"line 2"});
  expect_refused("1 255 0 0 1 1 1 \"a\"\n\"\n", {"line 2"});
  expect_refused("id,name\n1,a\nx,b\n", {"line 3", "'x'", "no label"});
  expect_refused("id,name\n1.5,a\n", {"line 2", "1.5"});
  expect_refused("id,name\n,a\n", {"line 2"});
  expect_refused("id,name\n18446744073709551616,a\n", {"line 2", "18446744073709551616"});
  expect_refused("id,name\n1,\"a\n2,b\n", {"line 2", "quote"});
  expect_refused("id,name,color\n1,a,#12345\n", {"line 2", "#12345", "#rrggbb"});
  expect_refused("id,name,color\n1,a,#12345g\n", {"line 2", "#12345g", "#rrggbb"});
  expect_refused("id,name,color\n1,a,#+1-234\n", {"line 2", "#+1-234", "#rrggbb"});
  expect_refused("id,name,r,g,b\n1,a,1,2,300\n", {"line 2", "300"});
  // Two's complement: one label.
  expect_refused("18446744073709551615,big\n-1,last\n", {"line 2", "label -1 is in line 1"});
  expect_refused("1 a 0 0 0 255\n# c\n2 a 0 0 0 255\n", {"line 3", "'a' is in line 1"});
  expect_refused("size,weight\n1,2\n", {"line 1", "id and name"});
  // A comma in a name that is not in quotes would cut it.
  expect_refused("1,a\n2,b,c\n", {"line 2", "'c'", "double quotes"});
  expect_refused("1,a,b\n", {"line 1", "'b'", "double quotes"});
  expect_refused("id,name\n1,a\n2,liver,left\n", {"line 3", "3 fields", "header 2", "quotes"});
  EXPECT_EQ(parse("id,name\n1,a,,\n").name(1), "a");
  expect_refused("id,weight\n1,2\n", {"line 1"});
  expect_refused(std::string("i\0d\0,\0", 6), {"UTF-16"});
}

/// Whatever the bytes: names, or an error about the file.
void expect_read_or_refused(const std::string& text) {
  try {
    EXPECT_FALSE(parse(text).empty());
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
    EXPECT_TRUE(std::string(error.what()).starts_with("table: ")) << error.what();
  }
}

TEST(ReadNames, DamagedTablesAreReadOrRefused) {
  const std::string tables[] = {
      "# c\n    1   255    0    0        1  1  1    \"Label 1\"\n 2 1 2 3 0.5 0 0 \"x\"\n",
      "#No\n0  Unknown  0 0 0 0\n17\tLeft_Hippocampus\t220\t216\t20\t0\n",
      "Label,Name,R,G,B\n1,\"liver, \"\"left\"\"\",255,128,0\n22,b,,,\n",
      "name;id;colour\nx;1;#ff8000\n"};
  for (const std::string& table : tables) {
    for (std::size_t size = 0; size < table.size(); ++size) {
      expect_read_or_refused(table.substr(0, size));
      for (int bit = 0; bit < 8; ++bit) {
        std::string flipped = table;
        flipped[size] = static_cast<char>(flipped[size] ^ (1 << bit));
        expect_read_or_refused(flipped);
      }
    }
  }
}

TEST(ReadNames, NoiseIsReadOrRefused) {
  std::mt19937 random(42);
  constexpr std::string_view kCharacters = "0123456789 \t\n\",;#.-+eax\r\xC3\xA9";
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (std::size_t n = below(random, 60); n > 0; --n) {
      text.push_back(kCharacters[below(random, kCharacters.size())]);
    }
    expect_read_or_refused(text);
  }
}

// Names as a table: order, search, merging; and what cleaning leaves of any bytes.

TEST(CleanName, AnyBytesBecomeUtf8WithoutControls) {
  std::mt19937 random(31);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes;
    for (std::size_t n = below(random, 40); n > 0; --n) {
      // Bytes that begin and continue characters, more often than others.
      const std::size_t kind = below(random, 4);
      const auto any = static_cast<unsigned>(random());
      bytes.push_back(static_cast<char>(kind == 0   ? 0x80U | (any & 0x3FU)
                                        : kind == 1 ? 0xC0U | (any & 0x3FU)
                                                    : any & 0xFFU));
    }
    const std::string clean = clean_name(bytes);
    EXPECT_EQ(clean_name(clean), clean);
    // Throws where it is no UTF-8.
    EXPECT_NO_THROW(static_cast<void>(nlohmann::json(clean).dump()));
    for (const char c : clean) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    EXPECT_FALSE(clean.starts_with(' ') || clean.ends_with(' '));
  }
}

TEST(CleanName, KeepsWhatIsClean) {
  for (const char* name : {"", "a", "Left-Cerebral_White.Matter 7", "\"<&>'\\", "Größe 漢字"}) {
    EXPECT_EQ(clean_name(name), name);
  }
  EXPECT_EQ(clean_name(" \ta\nb\x7F\xC2\x85 "), "a b");
  EXPECT_EQ(clean_name("a\xFF\xEF\xBF\xBF"), "a\xEF\xBF\xBD\xEF\xBF\xBD");
  // Overlong, a surrogate, beyond the last character, cut.
  for (const char* bad : {"\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE6\xBC"}) {
    EXPECT_TRUE(clean_name(bad).starts_with("\xEF\xBF\xBD")) << bad;
  }
}

TEST(CleanName, CutsLongNamesBetweenCharacters) {
  std::string name;
  for (int i = 0; i < 1000; ++i) name += "漢";
  EXPECT_EQ(clean_name(name), name.substr(0, 999));
  EXPECT_EQ(clean_name(std::string(5000, 'x')), std::string(kMaxNameBytes, 'x'));
}

TEST(LabelNames, FindsWhatAMapFinds) {
  std::mt19937 random(32);
  for (int i = 0; i < 300; ++i) {
    std::map<RawLabel, LabelName> expected;
    std::vector<LabelName> rows;
    for (std::size_t n = below(random, 30); n > 0; --n) {
      const LabelName row{below(random, 20), random_name(random), random_colour(random)};
      rows.push_back(row);
      if (row.name.empty() && !row.colour) continue;
      expected[row.label] = row;
    }
    const LabelNames names(rows);
    ASSERT_EQ(names.rows().size(), expected.size());
    EXPECT_EQ(names.empty(), expected.empty());
    for (RawLabel label = 0; label < 21; ++label) {
      const LabelName* found = names.find(label);
      ASSERT_EQ(found != nullptr, expected.contains(label));
      EXPECT_TRUE(found == nullptr || *found == expected[label]);
    }
  }
}

TEST(LabelNames, OthersWinPartByPart) {
  const Colour red{255, 0, 0, 255}, blue{0, 0, 255, 255};
  const LabelNames file({{1, "one", red}, {2, "two", {}}, {3, "three", red}});
  const LabelNames given({{1, "eins", {}}, {2, "", blue}, {4, "vier", {}}});
  expect_same_names(
      file.merged_with(given),
      LabelNames({{1, "eins", red}, {2, "two", blue}, {3, "three", red}, {4, "vier", {}}}));
  expect_same_names(file.merged_with({}), file);
  expect_same_names(LabelNames().merged_with(file), file);
  expect_same_names(file.only([](RawLabel label) { return label == 3; }),
                    LabelNames({{3, "three", red}}));
}

TEST(LabelNames, ColoursThatNobodySeesAreNone) {
  EXPECT_EQ(LabelNames({{0, "Clear", Colour{}}}).find(0)->colour, std::nullopt);
  EXPECT_TRUE(LabelNames({{0, " \n", Colour{}}}).empty());
}

}  // namespace
}  // namespace mw::io
