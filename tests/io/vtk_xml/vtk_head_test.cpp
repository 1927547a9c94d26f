// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The text of VTK's files with the places of contents in it.
#include "io/vtk_xml/vtk_head.h"

#include "io/file/errors.h"
#include "io/file/source/file_source.h"
#include "tests/io/test_files.h"

namespace mw::io {
namespace {

TEST(VtkHead, OutlineHasPlacesForContents) {
  const TempDir dir;
  const std::string plain =
      "<?xml version='1.0'?>\n<VTKFile type=\"ImageData\">\n<!-- a 'comment' with <DataArray> in "
      "it "
      "-->\n<DataArray Name=\"a>b\">";
  const std::string values = "\n 1 2 3\n";
  const std::string rest = "<InformationKey name=\"k\"> 5 </InformationKey></DataArray>\n";
  const std::string empty = "<DataArray offset=\"0\"/> x\n";
  const FileSource source(
      dir.file("a.vti", plain + values + rest + empty + "<AppendedData encoding=\"raw\">\n _\1\2"));
  const VtkHead head = read_outline(source);
  const std::string place = text(plain.size(), " ", plain.size() + values.size());
  EXPECT_EQ(head.xml, plain + place + rest + empty + "<AppendedData encoding=\"raw\">");
  ASSERT_TRUE(head.tag.has_value());
  EXPECT_EQ(*head.tag, plain.size() + place.size() + rest.size() + empty.size());
  EXPECT_EQ(head.tag_in_file, plain.size() + values.size() + rest.size() + empty.size());
}

TEST(VtkHead, WithContentsItIsTheTextInFrontOfAppendedData) {
  const TempDir dir;
  const std::string xml = "<VTKFile type=\"ImageData\"><DataArray>1 2</DataArray>";
  for (const std::size_t blanks : {0U, (1U << 20U) - 60U, (1U << 20U) - 50U, 1U << 20U}) {
    const std::string before = xml + std::string(blanks, ' ');
    const FileSource source(
        dir.file("a.vti", before + "<AppendedData encoding=\"base64\">_AAAA</AppendedData>"));
    const VtkHead head = read_head(source);
    EXPECT_EQ(head.xml, before + "<AppendedData encoding=\"base64\">");
    EXPECT_EQ(head.tag, before.size());
    EXPECT_EQ(head.tag_in_file, before.size());
    EXPECT_EQ(read_outline(source).tag_in_file, before.size());
  }
  const FileSource whole(dir.file("b.vti", xml + "</VTKFile>"));
  EXPECT_EQ(read_head(whole).xml, xml + "</VTKFile>");
  EXPECT_FALSE(read_outline(whole).tag.has_value());
}

TEST(VtkHead, OtherFilesAreRefused) {
  const TempDir dir;
  const FileSource source(dir.file("a.vti", "<svg></svg>"));
  expect_error(ErrorKind::kInput, {"a.vti", "VTKFile"},
               [&] { static_cast<void>(read_outline(source)); });
  expect_error(ErrorKind::kInput, {"a.vti", "VTKFile"},
               [&] { static_cast<void>(read_head(source)); });
}

}  // namespace
}  // namespace mw::io
