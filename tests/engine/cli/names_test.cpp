// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Names of labels as a user sees them: given beside the volume, in meshes and in reports.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

const std::string kNames =
    "id,name,color\n1,\"liver, <left>\",#ff8000\n2,\"a \"\"b\"\" & "
    "Größe\",\n3,,#01020304\n99,none,\n";

class NamesTest : public ProgramTest {
 protected:
  void SetUp() override {
    make_volume();
    write("names.csv", kNames);
  }

  /// The names of rows by label.
  static std::map<int, std::string> names_of(const json& rows) {
    std::map<int, std::string> out;
    for (const json& row : rows) {
      if (row.contains("name")) out[row["label"]] = row["name"];
    }
    return out;
  }
  [[nodiscard]] std::map<int, std::string> names_in_mesh(const std::string& arguments) const {
    return names_of(json::parse(run("info " + arguments + " --json").out)["volume"]["per_label"]);
  }
  static const std::map<int, std::string>& expected() {
    static const std::map<int, std::string> names{{1, "liver, <left>"}, {2, "a \"b\" & Größe"}};
    return names;
  }
};

TEST_F(NamesTest, ReachEveryMeshAndReport) {
  expect_done("mesh v.npy -o plain.vtu");
  const std::string digest = run("digest plain.vtu").out;
  EXPECT_TRUE(names_in_mesh("plain.vtu").empty());
  for (const std::string mesh : {"v.vtkhdf", "v.vtu", "v.mesh"}) {
    SCOPED_TRACE(mesh);
    expect_done("mesh v.npy -o " + mesh + " --names names.csv --report r.json");
    const json report = json::parse(read("r.json"));
    EXPECT_EQ(names_of(report["shape"]["per_label"]), expected());
    EXPECT_EQ(report["settings"]["names"], "names.csv");
    EXPECT_EQ(names_in_mesh(mesh), expected());
    EXPECT_EQ(run("digest " + mesh).out, digest);
    expect_done("convert " + mesh + " back.vtkhdf");
    EXPECT_EQ(names_in_mesh("back.vtkhdf"), expected());
    const json rows = json::parse(run("info " + mesh + " --json").out)["volume"]["per_label"];
    EXPECT_EQ(rows[0]["colour"], json::parse("[255, 128, 0, 255]"));
    EXPECT_FALSE(rows[1].contains("colour"));
    EXPECT_EQ(rows[2]["colour"], json::parse("[1, 2, 3, 4]"));
  }
  const std::string text = run("info v.vtu").out;
  EXPECT_NE(text.find("\n    1  liver, <left>  "), std::string::npos) << text;
}

TEST_F(NamesTest, VerifyNamesLabels) {
  expect_done("mesh v.npy -o v.vtu");
  const std::string all =
      "id,name\n1,n1\n2,n2\n3,n3\n4,n4\n5,n5\n6,n6\n7,n7\n8,n8\n9,n9\n10,n10\n"
      "11,n11\n12,n12\n";
  write("all.csv", all);
  const ProgramRun verified =
      run("verify v.npy v.vtu --names all.csv --max-distance 1.5 --report q.json");
  EXPECT_EQ(verified.code, 0) << verified.out;
  const json report = json::parse(read("q.json"));
  for (const json& rows : {report["volume"]["per_label"], report["distance"]["per_label"]}) {
    EXPECT_FALSE(rows.empty());
    for (const json& row : rows) {
      EXPECT_EQ(row["name"], "n" + row["label"].dump());
    }
  }
  EXPECT_NE(verified.out.find(" \"n"), std::string::npos) << verified.out;
  EXPECT_EQ(run("verify v.npy v.vtu --max-distance 1.5").out.find(" \"n"), std::string::npos);
  // Checks call labels by their numbers and names, not by their ranks.
  expect_done("mesh v.npy -o less.vtu --background 5");
  const std::string less = run("verify v.npy less.vtu --names all.csv --labels 4,5").out;
  EXPECT_NE(less.find("(label 5 \"n5\")"), std::string::npos) << less;
  EXPECT_EQ((verified.out + less).find("dense "), std::string::npos) << less;
}

TEST_F(NamesTest, OnlyWrittenLabelsAreNamedInTheMesh) {
  expect_done("mesh v.npy -o v.mesh --names names.csv --labels 2,3");
  const std::string mesh = read("v.mesh");
  EXPECT_EQ(mesh.find("# label 1 "), std::string::npos);
  EXPECT_EQ(mesh.find("# label 99 "), std::string::npos);
  EXPECT_NE(mesh.find("# label 2 \"a \\\"b\\\" & Größe\"\n# label 3 \"\" 1 2 3 4\nVertices\n"),
            std::string::npos);
}

int times_in(const ProgramRun& run, const std::string& part) {
  const std::string text = run.out + run.err;
  int count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; ++at) ++count;
  return count;
}

/// Tables that Excel and others write in Latin-1; that is said once, though names are looked up.
TEST_F(NamesTest, InLatin1AreReadAndTold) {
  write("latin.csv",
        "id,name\n2,Gr\xF6\xDF"
        "e\n");
  const ProgramRun meshed = run("mesh v.npy -o l.vtu --names latin.csv --labels Größe");
  EXPECT_EQ(meshed.code, 0) << meshed.err;
  EXPECT_EQ(times_in(meshed, "read as Latin-1"), 1) << meshed.err;
  EXPECT_EQ(names_in_mesh("l.vtu"), (std::map<int, std::string>{{2, "Größe"}}));
  EXPECT_EQ(times_in(run("info l.vtu --names latin.csv"), "read as Latin-1"), 1);
}

/// A file without a spacing; that is said once, too.
TEST_F(NamesTest, ASpacingThatIsTakenIsTold) {
  write("two.csv", "id,name\n2,two\n");
  const std::string line = "does not say how large voxels are";
  EXPECT_EQ(times_in(run("mesh v.npy -o s.vtu --names two.csv --labels two"), line), 1);
  EXPECT_EQ(times_in(run("mesh v.npy -o s.vtu --force --spacing 1"), line), 0);
  const std::string whole = read("v.npy"), voxels = whole.substr(whole.size() - 8000);
  const std::string head = "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 3\nsizes: 20 20 20\n";
  write("none.nrrd", head + "\n" + voxels);
  EXPECT_EQ(times_in(run("mesh none.nrrd -o s.vtu --force"), line), 1);
  write("one.nrrd", head + "spacings: 1 1 1\n\n" + voxels);
  EXPECT_EQ(times_in(run("mesh one.nrrd -o s.vtu --force"), line), 0);
}

TEST_F(NamesTest, ComeFromConfigEnvironmentAndVolume) {
  write("run.toml", "names = \"names.csv\"\n");
  expect_done("mesh v.npy -o a.vtu --config run.toml");
  EXPECT_EQ(names_in_mesh("a.vtu"), expected());
  expect_done("mesh v.npy -o b.vtu", "MW_NAMES=names.csv");
  EXPECT_EQ(names_in_mesh("b.vtu"), expected());
  EXPECT_EQ(read("a.vtu"), read("b.vtu"));
  const std::string whole = read("v.npy");
  write("v.seg.nrrd",
        "NRRD0004\ntype: uchar\nencoding: raw\ndimension: 3\nsizes: 20 20 20\n"
        "Segment0_Name:=Foie\nSegment0_LabelValue:=1\nSegment1_Name:=Rate\n"
        "Segment1_LabelValue:=4\n\n" +
            whole.substr(whole.size() - 8000));
  expect_done("mesh v.seg.nrrd -o c.mesh");
  EXPECT_EQ(names_in_mesh("c.mesh"), (std::map<int, std::string>{{1, "Foie"}, {4, "Rate"}}));
  expect_done("mesh v.seg.nrrd -o d.mesh --names names.csv");
  std::map<int, std::string> both = expected();
  both[4] = "Rate";
  EXPECT_EQ(names_in_mesh("d.mesh"), both);
  EXPECT_EQ(names_in_mesh("c.mesh --names names.csv"), both);
}

TEST_F(NamesTest, BadFilesFailBeforeTheWork) {
  expect_failure(3, "mesh v.npy -o v.vtu --names gone.csv", "gone.csv");
  write("bad.csv", "id,name\n1,a\nx,b\n");
  expect_failure(3, "mesh v.npy -o v.vtu --names bad.csv", "bad.csv: line 3");
  expect_failure(3, "info v.npy --names bad.csv", "bad.csv: line 3");
  write("bad.csv", "id,name\n1,a\n2,b\n1,c\n");
  expect_failure(3, "info v.npy --names bad.csv", "line 4: label 1 is in line 2, too");
  write("bad.csv", "id,name\n1,a\n2,\n3,\n4,a\n");
  expect_failure(3, "info v.npy --names bad.csv", "line 5: the name 'a' is in line 2, too");
  write("bad.txt", "1 a 1 2 3 255\n# b\n1 c 1 2 3 255\n");
  expect_failure(3, "info v.npy --names bad.txt", "line 3: label 1 is in line 1, too");
  expect_failure(2, "mesh v.npy -o names.vtu --names names.vtu", "this is --names");
  expect_failure(2, "mesh v.npy -o v.vtu --names names.csv --report names.csv", "used twice");
  EXPECT_EQ(read("names.csv"), kNames);
}

/// By its name a label is what it is by its number, wherever options have labels.
TEST_F(NamesTest, StandForLabelsInOptions) {
  write("all.csv", "id,name\n1,liver\n2,spleen\n3,\"a,b=c\"\n4,4th\n5,Twin\n6,twin\n7,seven\n");
  const std::string mesh = "mesh v.npy --names all.csv -o ";
  const auto same = [&](const std::string& named, const std::string& numbered) {
    SCOPED_TRACE(named);
    expect_done(mesh + "a.vtu " + named);
    expect_done(mesh + "b.vtu " + numbered);
    EXPECT_EQ(read("a.vtu"), read("b.vtu"));
  };
  same("--labels 'liver,4th, spleen ,7'", "--labels 1,4,2,7");
  same("--labels '\"a,b=c\", LIVER'", "--labels 3,1");
  same("--labels Twin", "--labels 5");
  same("--background spleen", "--background 2");
  same("--size liver=4,2=5", "--size 1=4,2=5");
  same("--size 'liver|spleen=3,4th=4,*=5'", "--size '1|2=3,4=4,*=5'");
  same("--merge 'liver,2=seven;4th=5'", "--merge '1,2=7;4=5'");
  write("run.toml", "labels = \"liver,spleen\"\n");
  same("--config run.toml", "--labels 1,2");
  expect_done(mesh + "v.vtu --background spleen --report r.json");
  EXPECT_EQ(json::parse(read("r.json"))["settings"]["background"], "2");
  expect_done("verify v.npy v.vtu --names all.csv --background spleen");
  expect_done("info v.npy --names all.csv --merge spleen=liver");
  expect_failure(2, mesh + "c.vtu --labels spleem",
                 "--labels spleem: no label is called 'spleem'; near it: spleen");
  expect_failure(2, mesh + "c.vtu --labels TWIN", "labels 5, 6 are called 'TWIN'");
  expect_failure(2, mesh + "c.vtu --size bone=4", "names are liver, spleen, a,b=c, 4th, Twin");
  for (const std::string wrong : {"nan", "inf", "abc", "liver"}) {
    for (const std::string place : {"4=", "liver=", "'\"a,b=c\"'="}) {
      expect_failure(2, mesh + "c.vtu --size " + place + wrong,
                     "expected a finite number, got '" + wrong + "'");
    }
  }
  same("--size '\"a,b=c\"=4'", "--size 3=4");
  expect_failure(2, mesh + "c.vtu --labels 1x3", "expected a label of at most 64 bits, got '1x3'");
  expect_failure(2, "mesh v.npy -o c.vtu --labels liver", "give labels names (--names)");
}

TEST_F(NamesTest, LeaveOutZeroWhereTheySayThatItIsNothing) {
  expect_done("synth spheres --shape 20,20,20 --labels 2 --seed 1 -o b.npy");
  const auto digest = [&](const std::string& options) {
    expect_done("mesh b.npy -o m.vtu " + options);
    expect_done("verify b.npy m.vtu");
    return run("digest m.vtu").out;
  };
  const std::string all = digest(""), inner = digest("--background 0");
  ASSERT_NE(all, inner);
  EXPECT_EQ(digest("--background none"), all);
  const std::vector<std::pair<std::string, bool>> cases{
      {"1,liver\n2,spleen\n", true},  {"1,liver\n2,spleen\n7,far\n", true},
      {"1,liver\n", false},           {"0,air\n1,liver\n2,spleen\n", false},
      {"0,Background\n", true},       {"0,Clear Label\n1,liver\n", true},
      {"0,UNKNOWN\n1,liver\n", true}, {"7,far\n", false}};
  for (const auto& [rows, is_nothing] : cases) {
    SCOPED_TRACE(rows);
    write("b.csv", "id,name\n" + rows);
    EXPECT_EQ(digest("--names b.csv"), is_nothing ? inner : all);
    const std::string out = run("mesh b.npy -o m.vtu --names b.csv").out;
    EXPECT_EQ(out.find("\nbackground  label 0 is left out") != out.npos, is_nothing) << out;
    EXPECT_EQ(digest("--names b.csv --background none"), all);
    EXPECT_EQ(digest("--names b.csv --labels 0,1,2"), all);
  }
  expect_failure(2, "mesh b.npy -o m.vtu --background none --labels 1", "not both");
}

/// A raw volume of random labels beside what a loop over its voxels finds.
TEST_F(NamesTest, InfoListsLabelsOfAVolume) {
  constexpr int kX = 70, kY = 20, kZ = 19;
  std::mt19937 random(61);
  std::string bytes;
  std::map<int, json> rows;
  for (int z = 0; z < kZ; ++z) {
    for (int y = 0; y < kY; ++y) {
      for (int x = 0; x < kX; ++x) {
        const bool rare = random() % 900 == 0;
        const int label = rare ? static_cast<int>(random() % 7) - 3 : 40 + (x / 9 + y / 7 + z / 5);
        bytes.push_back(static_cast<char>(label));
        json& row = rows[label];
        if (row.is_null()) row = {{"voxels", 0}, {"lo", {x, y, z}}, {"hi", {x + 1, y + 1, z + 1}}};
        const int at[] = {x, y, z};
        row["voxels"] = row["voxels"].get<int>() + 1;
        for (std::size_t i = 0; i < 3; ++i) {
          row["lo"][i] = std::min(row["lo"][i].get<int>(), at[i]);
          row["hi"][i] = std::max(row["hi"][i].get<int>(), at[i] + 1);
        }
      }
    }
  }
  write("v.raw", bytes);
  const std::string volume =
      "info v.raw --shape 70,20,19 --dtype i8 --spacing 1,2,3 --names names.csv ";
  const json facts = json::parse(run(volume + "--json").out);
  const json& labels = facts["labels"];
  EXPECT_EQ(labels["count"], rows.size());
  EXPECT_EQ(labels["min"], rows.begin()->first);
  EXPECT_EQ(labels["max"], rows.rbegin()->first);
  ASSERT_EQ(labels["per_label"].size(), rows.size());
  std::size_t i = 0;
  for (const auto& [label, row] : rows) {
    const json& listed = labels["per_label"][i++];
    EXPECT_EQ(listed["label"], label);
    for (const char* key : {"voxels", "lo", "hi"}) EXPECT_EQ(listed[key], row[key]) << label << key;
    EXPECT_EQ(listed.contains("name"), expected().contains(label));
  }
  EXPECT_EQ(facts["frame"], "own");
  EXPECT_EQ(facts["unit"], nullptr);
  EXPECT_EQ(facts["affine"], json::parse("[[1.0,0.0,0.0,0.0],[0.0,2.0,0.0,0.0],[0.0,0.0,3.0,0.0],"
                                         "[0.0,0.0,0.0,1.0]]"));
  EXPECT_EQ(facts["affine_of_centres"],
            json::parse("[[1.0,0.0,0.0,0.5],[0.0,2.0,0.0,1.0],[0.0,0.0,3.0,1.5],"
                        "[0.0,0.0,0.0,1.0]]"));
  const std::string text = run(volume).out;
  EXPECT_NE(text.find("\nlabel  name "), text.npos) << text;
  EXPECT_NE(text.find("  volume  lo_x  lo_y  lo_z  hi_x  hi_y  hi_z\n"), text.npos) << text;
  EXPECT_NE(text.find("\n    1  liver, <left>  "), text.npos) << text;
  EXPECT_NE(text.find("\naffine_of_centres [1,0,0,0.5] "), text.npos) << text;
  EXPECT_EQ(text.find("\naffine "), text.npos) << text;
  EXPECT_EQ(text.find("more labels"), text.npos);
}

TEST_F(NamesTest, InfoListsAThousandLabelsAsText) {
  std::string bytes;
  for (int label = 0; label < 1100; ++label) {
    bytes += {static_cast<char>(label & 255), static_cast<char>(label >> 8)};
  }
  write("v.raw", bytes);
  const std::string volume = "info v.raw --shape 11,10,10 --dtype u16 ";
  const std::string text = run(volume).out;
  EXPECT_NE(text.find("\n  999  "), text.npos);
  EXPECT_EQ(text.find("\n 1000  "), text.npos);
  EXPECT_NE(text.find("\n100 more labels; --json lists all\n"), text.npos) << text.substr(0, 500);
  EXPECT_EQ(json::parse(run(volume + "--json").out)["labels"]["per_label"].size(), 1100U);
}

/// Names that are exchanged in the file, or that the volume does not have, are told.
TEST_F(NamesTest, OfTheMeshAreThoseOfTheVolume) {
  for (const std::string mesh : {"v.vtkhdf", "v.vtu", "v.mesh", "v.msh"}) {
    SCOPED_TRACE(mesh);
    expect_done("mesh v.npy -o " + mesh + " --names names.csv");
    EXPECT_THAT(run("verify v.npy " + mesh + " --names names.csv").out,
                testing::HasSubstr("ok    names            2 labels with a name"));
    EXPECT_THAT(run("verify v.npy " + mesh).out, testing::Not(testing::HasSubstr("names")));
  }
  write("others.csv", "id,name\n1,spleen\n2,\"a \"\"b\"\" & Größe\"\n");
  const ProgramRun failed = run("verify v.npy v.vtu --names others.csv");
  EXPECT_EQ(failed.code, 5);
  EXPECT_THAT(failed.out, testing::HasSubstr("FAIL  names"));
  EXPECT_THAT(failed.out, testing::HasSubstr("1 is \"liver, <left>\", \"spleen\" in the volume"));
  EXPECT_THAT(failed.out, testing::HasSubstr("1 checks fail"));
  write("fewer.csv", "id,name\n2,\"a \"\"b\"\" & Größe\"\n");
  EXPECT_THAT(run("verify v.npy v.vtu --names fewer.csv").out,
              testing::HasSubstr("1 is \"liver, <left>\", nothing in the volume"));
}

/// Gmsh has no quotes, and version 2 only plain letters; the label follows where two names then are
/// one.  So it is where the table beside the mesh is lost.
TEST_F(NamesTest, AsGmshSpellsThemAreThoseOfTheVolume) {
  write("alike.csv", "id,name\n1,\"a \"\"b\"\n2,a 'b\n");
  const std::map<std::string, std::map<int, std::string>> spelled{
      {"v.msh", {{1, "a 'b (1)"}, {2, "a 'b (2)"}}}, {"v.msh2", {{1, "a_b_1"}, {2, "a_b_2"}}}};
  for (const auto& [mesh, names] : spelled) {
    expect_done("mesh v.npy -o " + mesh + " --names alike.csv");
    ASSERT_TRUE(std::filesystem::remove(folder() / (mesh + ".labels.csv")));
    EXPECT_EQ(names_in_mesh(mesh), names);
    EXPECT_THAT(run("verify v.npy " + mesh + " --names alike.csv").out,
                testing::HasSubstr("ok    names            2 labels with a name"));
  }
}

}  // namespace
}  // namespace mw::cli
