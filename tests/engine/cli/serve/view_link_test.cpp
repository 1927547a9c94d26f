// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A link that shows a folder of precomputed meshes in neuroglancer.
#include "engine/cli/serve/view_link.h"

#include "tests/expect_error.h"
#include "tests/temp_folder.h"

namespace mw::cli {
namespace {

constexpr const char* kInfo =
    R"({"mwmesh_box":[[0,-1,2.5],[10,1,4.5]],"segment_properties":"properties"})";
constexpr const char* kProperties = R"({"inline":{"ids":["0","7","18446744073709551613","9"],
    "properties":[{"id":"label","type":"label","values":["a","b","c","d"]},
                  {"id":"volume","type":"number","values":[9,2,4.5,2]},
                  {"id":"area","type":"number","values":[1,2,3,4]}]}})";

class ViewLinkTest : public testing::Test {
 protected:
  ViewLinkTest() { std::filesystem::create_directories(folder() / "properties"); }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder() / name) << content;
  }
  void write_both(const std::string& info, const std::string& properties) const {
    write("info", info);
    write("properties/info", properties);
  }
  [[nodiscard]] std::filesystem::path folder() const { return temp_.path() / "my meshes"; }

 private:
  mw::test::TempFolder temp_;
};

TEST_F(ViewLinkTest, ReadsBoxAndLargestSegments) {
  write_both(kInfo, kProperties);
  for (const std::filesystem::path& path : {folder(), folder() / "", folder() / "properties/.."}) {
    const FolderView view = read_folder_view(path);
    EXPECT_EQ(view.name, "my meshes") << path;
    EXPECT_EQ(view.low, (std::array<double, 3>{0, -1, 2.5}));
    EXPECT_EQ(view.high, (std::array<double, 3>{10, 1, 4.5}));
    // 0 is no segment; of two that are as large the first one comes first.
    EXPECT_EQ(view.segments, (std::vector<std::string>{"18446744073709551613", "7", "9"}));
  }
}

TEST_F(ViewLinkTest, GoesByAreasWhereSurfacesAreOpen) {
  std::string properties = kProperties;
  properties.replace(properties.find("\"volume\""), 8, "\"other\"");
  write_both(kInfo, properties);
  EXPECT_EQ(read_folder_view(folder()).segments,
            (std::vector<std::string>{"9", "18446744073709551613", "7"}));
}

TEST_F(ViewLinkTest, ShowsAHundredOfManySegments) {
  std::string ids, sizes;
  constexpr int kCount = 200'000;
  for (int i = 1; i <= kCount; ++i) {
    ids += (i > 1 ? ",\"" : "\"") + std::to_string(i) + "\"";
    sizes += (i > 1 ? "," : "") + std::to_string(i) + ".000000000000001";
  }
  write_both(kInfo, R"({"inline":{"ids":[)" + ids + R"(],"properties":[{"id":"volume","values":[)" +
                        sizes + "]}]}}");
  const FolderView view = read_folder_view(folder());
  ASSERT_EQ(view.segments.size(), 100U);
  EXPECT_EQ(view.segments.front(), std::to_string(kCount));
}

TEST_F(ViewLinkTest, SaysHowSuchAFolderIsMade) {
  const std::vector<std::string> pieces{folder().string() + ": no precomputed meshes",
                                        "mwmesh surface MESH --format draco -o FOLDER"};
  const auto expect_refused = [&] {
    expect_error(ErrorKind::kInput, pieces, [&] { (void)read_folder_view(folder()); });
  };
  expect_refused();
  const std::string more = R"(,"segment_properties":"properties"})";
  for (const std::string& info :
       {std::string("no JSON"), std::string("[]"), std::string(R"({"type":"segmentation"})"),
        R"({"mwmesh_box":[[0,0,0]])" + more, R"({"mwmesh_box":[[0,0,0],[1,1]])" + more,
        R"({"mwmesh_box":7)" + more, R"({"mwmesh_box":[[0,0,0],[1,1,"1"]])" + more,
        std::string(R"({"mwmesh_box":[[0,0,0],[1,1,1]]})"),
        std::string(R"({"mwmesh_box":[[0,0,0],[1,1,1]],"segment_properties":"none"})"),
        std::string(R"({"mwmesh_box":[[0,0,0],[1,1,1]],"segment_properties":"../properties"})")}) {
    SCOPED_TRACE(info);
    write_both(info, kProperties);
    expect_refused();
  }
  for (const char* properties :
       {"", "{}", R"({"inline":{"ids":["1"]}})", R"({"inline":{"ids":["1"],"properties":[]}})",
        R"({"inline":{"ids":["1"],"properties":[{"id":"volume","values":[1,2]}]}})",
        R"({"inline":{"ids":[1],"properties":[{"id":"volume","values":[1]}]}})",
        R"({"inline":{"ids":["1"],"properties":[{"id":"volume","values":[null]}]}})"}) {
    SCOPED_TRACE(properties);
    write_both(kInfo, properties);
    expect_refused();
  }
}

TEST(ViewLink, IsAStateInPercentEncoding) {
  const FolderView view{
      .name = "Größe #1%", .low = {0, -1, 2.5}, .high = {10, 1, 4.5}, .segments = {"7", "9"}};
  const std::string link = view_link(view, "http://127.0.0.1:8000", "https://viewer.example/");
  EXPECT_EQ(link,
            "https://viewer.example/#!%7B%22dimensions%22%3A%7B"
            "%22x%22%3A%5B1e-09%2C%22m%22%5D%2C%22y%22%3A%5B1e-09%2C%22m%22%5D%2C"
            "%22z%22%3A%5B1e-09%2C%22m%22%5D%7D%2C"
            "%22position%22%3A%5B5.0%2C0.0%2C3.5%5D%2C%22projectionScale%22%3A20.0%2C"
            "%22layout%22%3A%223d%22%2C%22showSlices%22%3Afalse%2C%22layers%22%3A%5B%7B"
            "%22type%22%3A%22segmentation%22%2C%22name%22%3A%22Gr%C3%B6%C3%9Fe%20%231%25%22%2C"
            "%22source%22%3A%22precomputed%3A//http%3A//127.0.0.1%3A8000%22%2C"
            "%22segments%22%3A%5B%227%22%2C%229%22%5D%7D%5D%7D");
}

}  // namespace
}  // namespace mw::cli
