// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// mwmesh surface as its user runs it: what it refuses, and what it leaves behind.
#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

class SurfaceCommand : public ProgramTest {
 protected:
  void make_mesh() const {
    make_volume();
    expect_done("mesh v.npy -o v.vtu");
  }
};

TEST_F(SurfaceCommand, RefusesWhatContradictsItself) {
  expect_failure(2, "surface m.vtu -o s.off", "'.off'");
  expect_failure(2, "surface m.vtu -o s.stl --format ply", "contradict");
  expect_failure(2, "surface m.vtu -o s.stl --format foo", "--format foo");
  expect_failure(2, "surface m.vtu -o s --format stl", "extension .stl");
  expect_failure(2, "surface m.vtu -o s.stl --each", "{label}");
  expect_failure(2, "surface m.vtu -o s.stl --unit nm", "--unit");
  expect_failure(2, "surface m.vtu -o s --unit ft", "--unit ft");
  expect_failure(2, "surface m.vtu -o 's/{label}'", "all labels");
  expect_failure(2, "surface m.vtu -o s --pair 1,2", "--pair");
  expect_failure(2, "surface m.vtu -o s --shift 1,2,3", "--shift");
  expect_failure(2, "surface m.vtu -o s.stl --pair 1,2 --labels 1", "--pair");
  expect_failure(2, "surface m.vtu -o '{label}.stl' --pair 1,2", "--pair");
  expect_failure(2, "surface m.vtu -o s.stl --pair 1", "--pair 1");
  expect_failure(2, "surface m.vtu -o s.stl --pair 3,3", "--pair 3,3");
  expect_failure(2, "surface m.vtu", "-o OUTPUT");
  expect_failure(3, "surface m.vtu -o s.stl", "m.vtu");
  expect_failure(3, "surface m.vtu -o s", "m.vtu");
}

TEST_F(SurfaceCommand, RefusesWhatTheMeshDoesNotHave) {
  make_mesh();
  expect_failure(2, "surface v.vtu -o s.stl --labels 77", "no label 77; mwmesh info v.vtu");
  expect_failure(2, "surface v.vtu -o s.stl --pair 77,1", "no label 77");
  expect_failure(2, "surface v.vtu -o 's/{label}.stl' --each --labels 77", "no label 77");
  expect_failure(2, "surface v.vtu -o s --labels 77", "no label 77");
  expect_failure(2, "surface v.vtu -o s.stl --labels x", "--labels x: no label has a name");
  write("x", "");
  expect_failure(2, "surface v.vtu -o x", "folder");
  expect_failure(2, "surface v.vtu -o missing/s.stl", "missing/s.stl");
  expect_done("mesh v.npy -o one.vtu --labels 1");
  expect_failure(2, "surface v.vtu --pair 4,4 -o s.stl", "two labels");
}

/// 3D Slicer looks for this word, and the command prints the frame.
TEST_F(SurfaceCommand, SaysWhichFrameItWrote) {
  make_mesh();
  EXPECT_NE(run("surface v.vtu -o s.stl").out.find("does not name"), std::string::npos);
  EXPECT_EQ(read("s.stl").find("SPACE="), std::string::npos);
  write("w.nrrd",
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 4 4 4\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n" +
            std::string(32, '1') + std::string(32, '2'));
  for (const char* frame : {"lps", "ras"}) {
    expect_done("mesh w.nrrd -o w.vtu --frame " + std::string(frame));
    const std::string out = run("surface w.vtu -o s.stl").out;
    EXPECT_TRUE(out.starts_with("coordinates " + std::string(frame) +
                                "\nsurface     open at 4 edges, manifold, 2 triangles\nnote  "))
        << out;
    EXPECT_NE(out.find("--labels A,B or --each writes closed ones"), std::string::npos) << out;
    const std::string space = frame == std::string("lps") ? "SPACE=LPS" : "SPACE=RAS";
    EXPECT_LT(read("s.stl").find(space), 80U);
  }
}

TEST_F(SurfaceCommand, TakesAVolumeAndSaysWhatIsWrongWithIt) {
  make_volume();
  expect_failure(3, "surface v.npy -o s.stl --labels 77", "v.npy: no voxel has 77");
  expect_failure(2, "surface v.npy -o s.stl --labels liver", "no label has a name");
  expect_failure(3, "surface v.npy -o s.stl --pair 1,77", "no voxel has 77");
  expect_failure(2, "surface v.npy -o s.stl --labels 1 --size 0", "--size 0");
  expect_failure(2, "surface v.npy -o s.off --labels 1", "'.off'");
  expect_failure(3, "surface missing.npy -o s.stl --labels 1", "missing.npy");
  write("bad.npy", "no array");
  expect_failure(3, "surface bad.npy -o s.stl --labels 1", "bad.npy");
  expect_failure(2, "surface v.npy -o v.npy --labels 1", "v.npy");
  expect_done("mesh v.npy -o v.vtu");
  expect_failure(2, "surface v.vtu -o s.stl --size 2", "--size: is about volumes, and v.vtu is a");
  expect_done("surface v.vtu -o s.stl", "MW_SIZE=2");
}

TEST_F(SurfaceCommand, SaysWhichSpacingWasTakenWhereAVolumeHasNone) {
  make_volume();
  const std::string note = "note        a spacing of 1 is taken";
  const std::string command = "surface v.npy -o s.stl --labels 1";
  EXPECT_NE(run(command).out.find(note), std::string::npos);
  EXPECT_EQ(run(command + " --spacing 2").out.find(note), std::string::npos);
}

/// Labels that voxels tell are meshed alone, others come out of the mesh of all.
TEST_F(SurfaceCommand, MeshesWhatLabelsNeed) {
  make_volume();
  const std::string alone = "all other labels taken for one";
  EXPECT_NE(run("surface v.npy -o a.stl --labels 1").out.find(alone), std::string::npos);
  EXPECT_NE(run("surface v.npy -o b.vtp --pair 1,2").out.find(alone), std::string::npos);
  for (const char* all : {"--labels 9 --merge 1,2=9", "--labels 1 --periodic x", "",
                          "--labels 1,2 --crop 0,0,0,20,20,10 --merge 3=4"}) {
    const ProgramRun done = run("surface v.npy -o c.vtp " + std::string(all));
    EXPECT_EQ(done.code, 0) << all << done.err;
    EXPECT_EQ(done.out.find(alone), std::string::npos) << all;
    EXPECT_NE(done.out.find("\nsurface     "), std::string::npos) << all;
  }
  expect_done("surface v.npy --each -o parts");
  for (const std::string& name : files()) EXPECT_FALSE(name.ends_with(".work")) << name;
}

TEST_F(SurfaceCommand, StlAndObjArePartedUnlessAskedOtherwise) {
  make_mesh();
  for (const char* extension : {".stl", ".obj", ".ply", ".vtp"}) {
    const std::string e = extension, surface = "surface v.vtu --labels 1 -o ";
    expect_done(surface + "a" + e);
    expect_done(surface + "b" + e + " --manifold");
    expect_done(surface + "c" + e + " --no-manifold");
    const bool is_printed = e == ".stl" || e == ".obj";
    EXPECT_EQ(read("a" + e), read((is_printed ? "b" : "c") + e)) << e;
  }
}

TEST_F(SurfaceCommand, AMeshOfOneLabelHasItsSurfaceAlone) {
  expect_done("synth voronoi --shape 8,8,8 --labels 1 --seed 1 -o v.npy");
  expect_done("mesh v.npy -o v.vtu");
  expect_failure(2, "surface v.vtu -o s.stl", "no interfaces");
  expect_failure(2, "surface v.vtu -o s.stl --manifold", "no interfaces");
  expect_failure(2, "surface v.vtu -o s.stl --labels 1 --open", "no interfaces");
  expect_failure(2, "surface v.vtu -o '{label}.stl' --each --open", "no interfaces");
  expect_done("surface v.vtu -o s.stl --labels 1");
}

TEST_F(SurfaceCommand, FilesAreTheSameEachTimeAndFromEveryMesh) {
  make_mesh();
  expect_done("convert v.vtu v.mesh");
  for (const std::string what : {"", " --labels 1,2 --manifold", " --pair 1,2", " --manifold"}) {
    expect_done("surface v.vtu -o a.ply" + what);
    expect_done("surface v.vtu -o b.ply" + what);
    expect_done("surface v.mesh -o c.ply" + what);
    EXPECT_EQ(read("a.ply"), read("b.ply")) << what;
    EXPECT_EQ(read("a.ply"), read("c.ply")) << what;
  }
  expect_done("surface v.vtu -o a --format draco --labels 1,2");
  expect_done("surface v.vtu -o b --format draco --labels 2,1");
  for (const std::string file : {"/info", "/1", "/1.index", "/2", "/2.index"}) {
    EXPECT_FALSE(read("a" + file).empty()) << file;
    EXPECT_EQ(read("a" + file), read("b" + file)) << file;
  }
}

TEST_F(SurfaceCommand, NothingIsLeftWhenTheDiskIsFull) {
  make_mesh();
  // A limit on the size of files instead of a full disk.
  for (const std::string out : {"s.stl", "s.ply", "s", "s --format draco"}) {
    expect_failure(4, "surface v.vtu -o " + out, "s", "ulimit -f 1;");
  }
  // Some labels have small surfaces, which a disk would still take.
  const auto before = files();
  expect_failure(4, "surface v.vtu -o 's{label}.ply'", "cannot write", "ulimit -f 1;");
  EXPECT_EQ(files(), before);
}

/// Files of labels get their names when all of them are whole.
TEST_F(SurfaceCommand, WritesAllLabelsOrNone) {
  make_mesh();
  std::filesystem::create_directory(folder() / "s4.ply");
  expect_failure(2, "surface v.vtu -o 's{label}.ply' --each", "s4.ply");
  std::filesystem::remove(folder() / "s4.ply");
  write("elsewhere", "");
  std::filesystem::create_symlink("elsewhere", folder() / "s4.ply");
  expect_done("surface v.vtu -o 's{label}.ply' --each");
  expect_done("surface v.vtu -o four.ply --labels 4");
  EXPECT_EQ(read("elsewhere"), read("four.ply"));
  for (const std::string& name : files()) EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST_F(SurfaceCommand, EachIsAnStlUnlessAskedOtherwise) {
  make_mesh();
  expect_done("surface v.vtu --labels 1,2 --each -o parts");
  expect_done("surface v.vtu --labels 1,2 --each -o parts --format ply");
  expect_done("surface v.vtu --labels 1 -o one.stl");
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder() / "parts")) {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names, (std::set<std::string>{"1.ply", "1.stl", "2.ply", "2.stl"}));
  EXPECT_EQ(read("parts/1.stl"), read("one.stl"));
  expect_done("surface v.vtu --labels 1 --each -o viewed --format precomputed");
  EXPECT_FALSE(read("viewed/info").empty());
}

TEST_F(SurfaceCommand, NamesFilesAfterLabels) {
  make_volume();
  write("names.csv", "id,name\n1,left liver\n2,../../etc/passwd\n3,a/b\n4,a\\b\n");
  expect_done("mesh v.npy -o v.vtu --names names.csv");
  expect_done("surface v.vtu -o '{name}.stl' --labels 1,2,5");
  expect_done("surface v.vtu -o '{label}.stl' --labels 1,2,5");
  EXPECT_EQ(read("left liver.stl"), read("1.stl"));
  EXPECT_EQ(read("_._.._etc_passwd.stl"), read("2.stl"));
  EXPECT_EQ(read("label_5.stl"), read("5.stl"));
  EXPECT_EQ(read("5.stl").empty(), false);
  expect_failure(2, "surface v.vtu -o '{name}.ply' --labels 3,4", "two labels would be a_b.ply");
  expect_done("surface v.vtu -o '{label}-{name}.ply' --labels 3,4");
  EXPECT_TRUE(files().contains("3-a_b.ply") && files().contains("4-a_b.ply"));
}

TEST_F(SurfaceCommand, PlacesThatFloatsDoNotHoldAreRefused) {
  make_volume();
  expect_done("mesh v.npy -o v.vtu --spacing 0.25 --origin 512345.5,4512345.25,812.75");
  expect_failure(2, "surface v.vtu -o s.stl", "s.stl: the format has 24 bits, too few for edges");
  expect_failure(2, "surface v.vtu -o '{label}.stl'", ".stl: the format has 24 bits");
  expect_failure(2, "surface v.vtu -o s", "--format draco");
  expect_done("surface v.vtu -o s --format draco");
  expect_done("surface v.vtu -o s.ply");
  expect_done("surface v.vtu -o s.stl --shift 512345,4512345,800");
  EXPECT_LT(read("s.stl").find("SHIFT=512345,4512345,800"), 80U);
}

TEST_F(SurfaceCommand, TakesNamesOfLabels) {
  make_volume();
  write("names.csv", "id,name\n1,liver\n2,Liver left\n");
  expect_done("mesh v.npy -o v.vtu --names names.csv");
  expect_done("surface v.vtu -o a.stl --label 'liver left'");
  expect_done("surface v.vtu -o b.stl --label 2");
  EXPECT_EQ(read("a.stl"), read("b.stl"));
  expect_done("surface v.vtu -o c.stl --pair liver,'Liver left'");
  expect_failure(2, "surface v.vtu -o c.stl --label livr", "near it: liver");
  expect_failure(2, "surface v.vtu -o c.stl --label bone", "names are liver, Liver left");
  expect_done("picture v.vtu -o c.png --labels LIVER --pixels 64x64");
  expect_done("mesh v.npy -o w.vtu");
  expect_failure(2, "surface w.vtu -o c.stl --label liver", "no label has a name");
}

}  // namespace
}  // namespace mw::cli
