// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Bad usage and bad input: exit codes, messages, nothing left behind.
#include <nlohmann/json.hpp>

#include "tests/engine/cli/run_program.h"

namespace mw::cli {
namespace {

using nlohmann::json;

class UsageTest : public ProgramTest {};

TEST_F(UsageTest, SaysItsVersion) {
  EXPECT_EQ(run("--version").out.substr(0, 7), "mwmesh ");
  EXPECT_EQ(run("-v").out, run("--version").out);
  EXPECT_EQ(run("mesh --version").out, run("--version").out);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

TEST_F(UsageTest, HelpIsOneLineAnOption) {
  std::vector<std::string> commands;
  for (const std::string& line : lines_of(run("help").out)) {
    if (line.starts_with("  ")) commands.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  ASSERT_EQ(commands.size(), 9U);
  for (const std::string& command : commands) {
    EXPECT_EQ(run("help " + command).out, run(command + " --help").out) << command;
    for (const std::string& line : lines_of(run(command + " --help-all").out)) {
      EXPECT_LE(line.size(), 100U) << command << ": " << line;
    }
  }
}

TEST_F(UsageTest, UsageNamesWhatIsRequired) {
  const std::string synth = run("synth --help").out;
  EXPECT_NE(synth.find("synth KIND --shape X,Y,Z --count N --seed S -o OUTPUT"), std::string::npos)
      << synth;
  EXPECT_EQ(run("stats --help").out, run("info --help").out);
}

TEST_F(UsageTest, HelpOfMeshIsShort) {
  const std::vector<std::string> lines = lines_of(run("mesh --help").out);
  EXPECT_LE(lines.size(), 45U);
  const auto is_option = [](const std::string& line) { return line.starts_with("  "); };
  EXPECT_LE(std::count_if(lines.begin(), lines.end(), is_option), 24);
  for (const char* group : {"Input:", "What to mesh:", "Shape and size:", "Run:", "Output:"}) {
    EXPECT_EQ(std::count(lines.begin(), lines.end(), group), 1) << group;
  }
  const std::string all = run("mesh --help-all").out;
  EXPECT_NE(all.find("--edge-variance"), std::string::npos);
  EXPECT_EQ(run("mesh --help").out.find("--edge-variance"), std::string::npos);
}

TEST_F(UsageTest, AnEmptyValueTakesNoOtherArgument) {
  expect_failure(2, "mesh seg.nii.gz -o o.vtu --report= --ascii", "--report: empty value");
  expect_failure(2, "mesh seg.nii.gz -o o.vtu --names= --threads 1", "--names: empty value");
}

TEST_F(UsageTest, UnknownCommandsAndFlagsAreNamed) {
  expect_failure(2, "mehs seg.nii.gz -o o.vtu",
                 "mehs: unknown command; did you mean mesh?; see mwmesh --help");
  expect_failure(2, "help mehs", "mehs: unknown command");
  expect_failure(2, "mesh v.npy -o v.vtu --windwo=16",
                 "--windwo: unknown flag; did you mean --window?; see mwmesh mesh --help");
  expect_failure(2, "mesh v.npy -o v.vtu --xyzzy", "--xyzzy: unknown flag; see");
  // Though a flag that must be there is missing then.
  expect_failure(2, "synth voronoi --shap 3,3,3 --labels 2 --seed 1 -o w.npy",
                 "--shap: unknown flag");
  expect_failure(2, "mesh v.npy -o v.vtu --threads 1 --threads 2",
                 "--threads: is given more than once; see mwmesh mesh --help");
  expect_failure(2, "mesh v.npy -o v.vtu --threads", "--threads: 1 required");
}

TEST_F(UsageTest, SaysWhatWasForgotten) {
  make_volume();
  expect_failure(2, "mesh v.npy x.vtu", "x.vtu: one argument too many; to write it, give -o x.vtu");
  expect_failure(2, "picture x.vtu x.png", "give -o x.png");
  expect_failure(2, "mesh v.npy x.vtu -o y.vtu", "x.vtu: one argument too many; see mwmesh mesh");
  expect_failure(2, "v.npy", "v.npy: no command; give mwmesh mesh v.npy -o OUTPUT.vtu; see");
  write("v.vtu", "");
  expect_failure(2, "v.vtu --json", "v.vtu: no command; give mwmesh info v.vtu; see");
  for (const char* command :
       {"picture v.npy -o p.png", "convert v.npy c.vtu", "digest v.npy", "verify v.npy v.npy"}) {
    expect_failure(2, command, "if it is a volume, mesh it first: mwmesh mesh");
  }
  expect_failure(2, "convert v.stl c.vtu", "mwmesh surface MESH -o");
}

TEST_F(UsageTest, RefusesUnknownWords) {
  make_volume();
  expect_failure(2, "", "a command is needed");
  expect_failure(2, "mesh v.npy -o v.vtu --foo", "--foo");
  expect_failure(2, "mesh v.npy -o v.vtu extra", "extra");
  expect_failure(2, "synth cubes --shape 3,3,3 --labels 2 --seed 1 -o w.npy", "cubes");
}

TEST_F(UsageTest, RefusesBadValues) {
  make_volume();
  expect_failure(2, "mesh v.npy -o v.vtu --window 41", "--window 41: must be an even");
  expect_failure(2, "mesh v.npy -o v.vtu --window 4e1", "--window 4e1: expected an integer");
  expect_failure(2, "mesh v.npy -o v.vtu --window 40", "MW_ORDER=x: expected one of", "MW_ORDER=x");
  expect_failure(2, "mesh v.npy -o v.vtu --spacing nan,1,1",
                 "--spacing nan,1,1: expected a finite");
  expect_failure(2, "mesh v.npy -o v.vtu --spacing 1,1", "three numbers");
  expect_failure(2, "mesh v.npy -o v.vtu --spacing 1,-1,1",
                 "error: --spacing 1,-1,1: expected positive numbers");
  expect_failure(2, "mesh v.npy -o v.vtu --origin inf,0,0", "finite");
  expect_failure(2, "mesh v.npy -o v.vtu --edge-variance 0", "--edge-variance 0");
  expect_failure(2, "mesh v.npy -o v.vtu --quality-floor 0.9", "quality-floor");
  expect_failure(2, "mesh v.npy -o v.vtu --max-distance -1", "--max-distance -1");
  expect_failure(2, "mesh v.npy -o v.vtu --memory 4GX", "4GX");
  expect_failure(2, "mesh v.npy -o v.vtu --threads -1", "from 1 to 1024, or 0");
  expect_failure(2, "mesh v.npy -o v.vtu --labels 1,x", "label");
  expect_failure(2, "mesh v.npy -o ''", "empty");
}

TEST_F(UsageTest, RefusesContradictions) {
  make_volume();
  expect_failure(2, "mesh v.npy -o v.vtu --window 8 --window 16", "--window");
  expect_failure(2, "mesh v.npy -o v.npy", "this is the input");
  expect_failure(2, "mesh v.npy -o w.vtu --report w.vtu", "used twice");
  expect_failure(2, "mesh v.npy -o w.vtu --report v.npy", "used twice");
  expect_failure(2, "mesh v.npy -o w.vtu --trace w.vtu", "used twice");
  expect_failure(2, "mesh v.npy -o w.vtu --report r --trace ./r", "used twice");
  expect_failure(2, "mesh v.npy -o w.vtu --labels 1 --background 2", "one of them");
  expect_failure(2, "mesh v.npy -o w.vtu --dtype u8", "--shape");
  expect_failure(2, "mesh v.npy -o w.vtu --shape 20,20,20", "--dtype");
  expect_failure(2, "mesh v.npy -o w.vtu --labels 1,99", "no label 99");
  expect_failure(2, "mesh v.npy -o w.vtu --report .", "--report .: this is a folder");
  expect_failure(2, "mesh v.npy -o w.vtu --html ..", "--html ..: this is a folder");
  expect_failure(2, "mesh -v.npy -o w.vtu", "./-v.npy");
  expect_failure(2, "mesh -hello.npy -o w.vtu", "./-hello.npy");
}

/// A variable may name a folder once for all runs; a flag is meant for the run at hand.
TEST_F(UsageTest, RefusesFoldersThatTheRunDoesNotUse) {
  make_volume();
  const std::string mesh = "mesh v.npy -o v.vtu";
  expect_failure(2, mesh + " --keep k --workdir w", "--workdir: is not used beside --keep");
  expect_done(mesh + " --keep k", "MW_WORKDIR=w");
  expect_failure(2, mesh + " --from k --workdir w", "--workdir: is not used beside --from");
  expect_done(mesh + " --from k", "MW_WORKDIR=w");
  EXPECT_FALSE(files().contains("w"));
  const std::string why = "--cache: keeps what servers send, and v.npy comes from no server";
  for (const std::string& command :
       {mesh, std::string("info v.npy"), std::string("info v.vtu v.npy"),
        std::string("verify v.npy v.vtu")}) {
    expect_failure(2, command + " --cache c", why);
    expect_done(command, "MW_CACHE=c");
  }
  EXPECT_FALSE(files().contains("c"));
}

TEST_F(UsageTest, RefusesTetgenWithoutItsWorker) {
  make_volume();
  const std::string mesh = "mesh v.npy -o v.vtu --optimizer tetgen";
  expect_failure(2, mesh, "no program /nowhere/worker", "MW_CODT_WORKER=/nowhere/worker");
  expect_failure(2, mesh, "no program /dev", "MW_CODT_WORKER=/dev");
  write("text", "no program");
  expect_failure(2, mesh, "no program ./text", "MW_CODT_WORKER=./text");
  expect_failure(2, mesh, "cannot start ./text", "chmod +x text && MW_CODT_WORKER=./text");
  expect_failure(2, mesh + " --odt-iterations 0", "--odt-iterations 0");
}

TEST_F(UsageTest, RefusesUnwritableOutputBeforeWork) {
  make_volume();
  expect_failure(2, "mesh v.npy -o nowhere/v.vtu", "nowhere/v.vtu");
  expect_failure(2, "mesh v.npy -o v.vtu --report nowhere/r.json", "nowhere/r.json");
  expect_failure(2, "mesh v.npy -o v.xyz", "v.xyz");
  expect_failure(2, "mesh v.npy -o v.stl", "mwmesh surface MESH -o");
  expect_failure(2, "mesh v.npy -o v.vtk", "; .vtu is");
  expect_failure(2, "mesh v.npy", "OUTPUT");
  expect_failure(2, "mesh -o v.vtu", "INPUT");
}

/// What it wrote itself is replaced as ever, whatever the format keeps of a run.
TEST_F(UsageTest, ReplacesNothingButItsOwnMeshes) {
  make_volume();
  write("v.vtu", "Dear Sir,");
  expect_failure(2, "mesh v.npy -o v.vtu", "v.vtu: is there, and not of mwmesh; --force");
  EXPECT_EQ(read("v.vtu"), "Dear Sir,");
  expect_done("mesh v.npy -o v.vtu --force");
  write("empty.vtu", "");
  for (const char* name : {"empty.vtu", "v.vtu", "v.vtkhdf", "v.mesh", "v.msh", "v.msh2", "v.inp",
                           "v.xdmf", "v.feb", "v.exo", "v.bdf", "v.k", "v.cdb"}) {
    expect_done(std::string("mesh v.npy -o ") + name);
    expect_done(std::string("mesh v.npy -o ") + name);
  }
}

/// Every file that a command writes, each by itself, and then once more over its own.
TEST_F(UsageTest, ReplacesNothingButItsOwnFiles) {
  make_volume();
  expect_done("mesh v.npy -o k.vtu --keep k");
  expect_done("mesh v.npy -o m.vtu --periodic x");
  const std::string mesh = "mesh v.npy -o m.vtu --periodic x ";
  const std::string synth = "synth spheres --shape 9,8,7 --count 2 --seed 1 -o ";
  const std::vector<std::array<std::string, 2>> cases{
      {"r.json", mesh + "--report r.json"},
      {"p.html", mesh + "--html p.html"},
      {"t.csv", mesh + "--trace t.csv"},
      {"d.json", "mesh v.npy -o k.vtu --from k --delta d.json"},
      {"pairs.csv", mesh + "--pairs pairs.csv"},
      {"pairs.inp", mesh + "--pairs pairs.inp"},
      {"c.vtu", "convert m.vtu c.vtu"},
      {"c.inp", "convert m.vtu c.inp"},
      {"c.xdmf.labels.csv", "convert m.vtu c.xdmf"},
      {"q.csv", "convert m.vtu c.vtu --pairs q.csv"},
      {"s.stl", "surface m.vtu -o s.stl"},
      {"s.ply", "surface m.vtu -o s.ply"},
      {"s.obj", "surface m.vtu -o s.obj"},
      {"s.vtp", "surface m.vtu -o s.vtp"},
      {"e4.ply", "surface m.vtu -o 'e{label}.ply'"},
      {"p.png", "picture m.vtu -o p.png --pixels 64x64"},
      {"y.npy", synth + "y.npy"},
      {"z.npy", synth + "z.npy --dtype u32"},
      {"vr.json", "verify v.npy m.vtu --report vr.json"}};
  for (const auto& [file, command] : cases) {
    write(file, "my measurements");
    expect_failure(2, command, file + ": is there, and not of mwmesh");
    EXPECT_EQ(read(file), "my measurements");
    expect_done(command + " --force");
    EXPECT_NE(read(file), "my measurements");
    expect_done(command);
  }
  // What numpy writes is not ours.
  const std::string dict = "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2, 2), }";
  const std::string numpy = std::string("\x93NUMPY\1\0v\0", 10) + dict +
                            std::string(117 - dict.size(), ' ') + "\n" + std::string(8, '\1');
  write("seg.npy", numpy);
  expect_done("info seg.npy");
  expect_failure(2, synth + "seg.npy", "seg.npy: is there, and not of mwmesh; --force replaces it");
  EXPECT_EQ(read("seg.npy"), numpy);
}

/// Files beside a mesh are known by the mesh; where that is not there, by themselves.
TEST_F(UsageTest, ReplacesNothingButItsOwnBesideAMesh) {
  make_volume();
  for (const char* name : {"v.h5", "v.cells.xdmf", "v.xdmf.labels.csv", "v.facets.csv"}) {
    write(name, "my measurements");
    expect_failure(2, "mesh v.npy -o v.xdmf", std::string("-o ") + name + ": is there, and not of");
    EXPECT_EQ(read(name), "my measurements");
    std::filesystem::remove(folder() / name);
  }
  write("v.inp.materials.csv", "my measurements");
  expect_failure(2, "mesh v.npy -o v.inp --sample x=v.npy --materials x=2", "v.inp.materials.csv");
  write("v.h5", "my measurements");
  expect_done("mesh v.npy -o v.xdmf --force");
  expect_done("mesh v.npy -o v.xdmf");
  // What a kill between two names leaves.
  std::filesystem::remove(folder() / "v.xdmf");
  expect_done("mesh v.npy -o v.xdmf");
}

constexpr const char* kBackground = "\nnote        label 0, maybe the background, is meshed, too, ";

TEST_F(UsageTest, SaysWhatWasMeshed) {
  expect_done("synth spheres --shape 20,20,20 --labels 2 --seed 1 -o v.npy");
  write("names.csv", "id,name\n0,air\n1,ball\n");
  const std::string all = run("mesh v.npy -o v.vtu --names names.csv").out;
  EXPECT_NE(all.find("\nlabels      3: 0 \"air\", 1 \"ball\", 2; fewest tets: "), all.npos) << all;
  EXPECT_NE(all.find(kBackground), all.npos) << all;
  const std::string two = run("mesh v.npy -o v.vtu --background 0").out;
  EXPECT_NE(two.find("\nlabels      2 of 3: 1, 2; fewest"), two.npos) << two;
  EXPECT_EQ(two.find(kBackground), two.npos) << two;
  make_volume("many.npy");
  const std::string many = run("mesh many.npy -o v.vtu").out;
  EXPECT_NE(many.find("\nlabels      9: 1, 2, 3, 4, 5, 6, ...; fewest"), many.npos) << many;
  EXPECT_EQ(many.find(kBackground), many.npos) << many;
  expect_done("synth voronoi --shape 8,8,8 --labels 1 --seed 1 -o one.npy");
  const std::string one = run("mesh one.npy -o v.vtu").out;
  EXPECT_NE(one.find("\nlabels      1: 1\n"), one.npos) << one;
  EXPECT_NE(one.find("\nnote        the volume has one label alone"), one.npos) << one;
}

/// The lines stand in the order of what one asks first, and what to look at comes last.
TEST_F(UsageTest, SaysFirstWhatOneAsksFirst) {
  expect_done("synth spheres --shape 40,40,40 --labels 2 --seed 1 -o v.npy");
  const std::string out =
      run("mesh v.npy -o v.vtu --spacing 2,2,2 --drop-specks 2 --report r.json").out;
  std::vector<std::string> names;
  for (const std::string& line : lines_of(out)) {
    const std::string name = line.substr(0, line.find(' '));
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  const std::vector<std::string> expected{"tets",   "edges", "shape", "volumes", "labels", "specks",
                                          "checks", "time",  "file",  "note",    "next"};
  EXPECT_EQ(names, expected) << out;
  const json r = json::parse(read("r.json"));
  EXPECT_EQ(r["attention"].size(), 1U) << r["attention"];
  EXPECT_NE(out.find("\nnote        " + r["attention"][0].get<std::string>() + "\n"), out.npos);
  EXPECT_LT(r["quality"]["edge_min"], r["quality"]["edge_median"]);
  EXPECT_LT(r["quality"]["edge_median"], r["quality"]["edge_max"]);
}

/// The number of tets that a size is said to give is near to what it does give.
TEST_F(UsageTest, SuggestsASize) {
  expect_done("synth spheres --shape 64,64,64 --labels 3 --seed 2 -o v.npy");
  expect_done("mesh v.npy -o v.vtu --background 0 --report r.json");
  const json next = json::parse(read("r.json"))["suggestion"];
  ASSERT_FALSE(next.is_null());
  const std::string size = std::to_string(next["size"].get<double>());
  const std::string out =
      run("mesh v.npy -o v.vtu --background 0 --report s.json --size " + size).out;
  EXPECT_EQ(out.find("\nnext "), out.npos) << out;
  const json made = json::parse(read("s.json"));
  const double tets = made["output"]["tets"];
  EXPECT_NEAR(next["tets"].get<double>() / tets, 1, 0.4);
  EXPECT_TRUE(made["suggestion"].is_null());
}

TEST_F(UsageTest, RefusesBadInput) {
  make_volume();
  const std::string whole = read("v.npy");
  write("short.npy", whole.substr(0, whole.size() - 100));
  std::string floats = whole;
  floats.replace(floats.find("|u1"), 3, "<f4");
  write("float.npy", floats);
  write("empty.npy", "");
  write("what.bin", "what is this");
  expect_failure(3, "mesh missing.npy -o v.vtu", "missing.npy");
  write("long.raw", std::string(1 << 20, 'a'));
  expect_failure(
      3, "mesh long.raw --shape 1048576,1,1 --dtype u8 -o v.vtu",
      "1048576 voxels along an axis; fewer than 524288 can be meshed at once: mesh parts "
      "of it with --crop");
  expect_failure(3, "mesh long.raw --shape 1048577,1,1 --dtype u8 -o v.vtu", "is above 1048576");
  expect_failure(3, "mesh short.npy -o v.vtu", "short.npy");
  expect_failure(3, "mesh float.npy -o v.vtu", "float.npy");
  expect_failure(3, "mesh empty.npy -o v.vtu --report r.json", "empty");
  expect_failure(3, "mesh what.bin -o v.vtu", "what.bin");
  expect_failure(3, "mesh . -o v.vtu", ".");
  expect_failure(3, "verify v.npy missing.vtu", "missing.vtu");
  expect_failure(2, "verify v.npy what.bin", "what.bin");
  write("bad.vtu", "<VTKFile>");
  for (const char* command : {"digest bad.vtu", "info bad.vtu", "convert bad.vtu b.mesh"}) {
    expect_failure(3, command, "bad.vtu");
  }
}

TEST_F(UsageTest, EndsWithFourWhenTheDiskIsFull) {
  make_volume();
  for (const std::string name : {"v.vtkhdf", "v.vtu", "v.mesh"}) {
    expect_failure(4, "mesh v.npy -o " + name, ": cannot ", "ulimit -f 8 &&");
    expect_failure(2, "mesh v.npy -o nowhere/" + name, "nowhere");
  }
  expect_failure(4, "info v.npy", "standard output", "sh -c '\"$0\" \"$@\" >/dev/full'");
}

/// The mesh is whole all the same, and the message says so.
TEST_F(UsageTest, SaysThatTheMeshIsCompleteWhereTheSummaryIsLost) {
  make_volume();
  const ProgramRun result =
      run("mesh v.npy -o v.vtu --report r.json", "sh -c '\"$0\" \"$@\" >/dev/full'");
  EXPECT_EQ(result.code, 4);
  EXPECT_NE(result.err.find("standard output; v.vtu is complete"), std::string::npos) << result.err;
  EXPECT_NE(read("r.json").find("\"digest\""), std::string::npos);
  expect_done("verify v.npy v.vtu");
}

TEST_F(UsageTest, NeedsSomeStack) {
  make_volume();
  expect_failure(4, "mesh v.npy -o v.vtu", "ulimit -s", "sh -c 'ulimit -s 64; exec \"$0\" \"$@\"'");
  expect_done("mesh v.npy -o v.vtu", "sh -c 'ulimit -S -s 64; exec \"$0\" \"$@\"'");
}

/// What the search for specks holds counts, too; the budget of a user who does as told is enough.
TEST_F(UsageTest, NamesABudgetThatIsEnough) {
  expect_done("synth noise --shape 32,32,32 --count 200 --seed 1 -o n.npy");
  const std::string mesh = "mesh n.npy -o n.vtu --drop-specks 5 --memory ";
  const ProgramRun refused = run(mesh + "45MiB");
  ASSERT_EQ(refused.code, 4) << refused.err;
  const std::string::size_type at = refused.err.find("--memory ");
  ASSERT_NE(at, std::string::npos) << refused.err;
  std::istringstream named(refused.err.substr(at + 9));
  std::string memory;
  std::getline(named, memory, 'B');
  expect_done(mesh + memory + "B");
}

/// The first file that is opened would get the number of a closed stream, and the messages with it.
TEST_F(UsageTest, WritesNoMessagesIntoAMeshWhenStreamsAreClosed) {
  make_volume();
  for (const std::string ending : {".vtu", ".vtkhdf", ".msh"}) {
    expect_done("mesh v.npy -o whole" + ending);
    for (const std::string closed : {">&-", "2>&-", "<&- >&- 2>&-"}) {
      const std::string warned = " --resume --force -o m" + ending;  // nothing to resume: a warning
      (void)run("mesh v.npy" + warned, "sh -c '\"$0\" \"$@\" " + closed + "'");
      EXPECT_EQ(read("m" + ending), read("whole" + ending)) << ending << " " << closed;
    }
  }
}

/// Reading the labels of 4 GiB, most of them holes in the file, takes more than a second.
TEST_F(UsageTest, EndsWith130AndCleanWhenInterrupted) {
  (void)run("--version", "truncate -s 4G n.raw &&");
  expect_failure(130, "mesh n.raw --shape 2048,2048,1024 --dtype u8 -o n.vtu --report r.json",
                 "interrupted", "timeout --foreground --preserve-status -s INT 1");
}

TEST_F(UsageTest, ConvertWritesTwoFilesUnderTwoNames) {
  expect_done("synth spheres --shape 8,8,8 --labels 2 --seed 1 -o v.npy");
  expect_done("mesh v.npy -o v.vtu --periodic x");
  expect_failure(2, "convert v.vtu z.inp --pairs z.inp", "--pairs z.inp: name used twice");
}

/// Points of the lattice are told apart in what is written, or the run is refused; up to what the
/// message says it works.
TEST_F(UsageTest, CoordinatesThatCannotBeToldApart) {
  expect_done("synth spheres --shape 12,12,12 --labels 2 --seed 1 -o v.npy");
  expect_failure(3, "mesh v.npy -o v.vtu --origin=4e15,4e15,4e15", "--origin nearer to 0");
  expect_failure(3, "mesh v.npy -o v.vtu --spacing 1e300,1e300,1e300", "1e+30");
  expect_failure(3, "mesh v.npy -o v.vtu --preset fine --spacing 1e300,1e300,1e300", "1e+30");
  expect_failure(3, "mesh v.npy -o v.vtu --spacing 5e-324,5e-324,5e-324", "1e-30");
  expect_failure(3, "mesh v.npy -o v.vtu --spacing 4e-9,4e-9,4e-9 --origin=100,0,0", "can reach");
  for (const std::string position :
       {"--origin=1.7e10,-1.7e10,1.7e10", "--spacing 4e-9,4e-9,4e-9 --origin=0.5,-50,0.5",
        "--spacing 1e-30,1e-30,1e-30", "--spacing 1e28,1e28,1e28"}) {
    expect_done("mesh v.npy -o v.vtu " + position);
    expect_done("verify v.npy v.vtu " + position);
  }
}

TEST_F(UsageTest, VariablesWhateverTheSubcommand) {
  make_volume();
  for (const std::string words : {"mesh --print-config", "info v.npy", "digest v.vtu",
                                  "synth voronoi --shape 3,3,3 --labels 2 --seed 1 -o w.npy"}) {
    expect_failure(2, words, "MW_THREDS: no option has this environment variable; unset it, or see",
                   "MW_THREDS=2");
    expect_failure(2, words, "MW_FOO: no option", "MW_FOO=1");
    expect_failure(2, words, "MW_: no option", "MW_=1");
  }
}

TEST_F(UsageTest, VariablesOfOtherSubcommandsAreFine) {
  make_volume();
  expect_done("info v.npy", "MW_THREADS=2");
  expect_done("mesh --print-config", "MW_MAX_VOLUME_ERROR=0.1");
  expect_done("info v.npy", "MW_CODT_WORKER=/nowhere");
  expect_done("info v.npy", "MW_PROGRAM=mwmesh MW_TEST_KILLS=3 MWFOO=1 MW_EMPTY=");
  expect_done("--version", "MW_FOO=1");
}

/// A flag that has no variable: setting one would change nothing.
TEST_F(UsageTest, VariablesOfFlagsThatHaveNone) {
  make_volume();
  expect_failure(2, "info v.npy", "MW_JSON: no option", "MW_JSON=1");
  expect_failure(2, "mesh --print-config", "MW_CONFIG: no option", "MW_CONFIG=c.toml");
  // MW_COUNT is a number of tets.
  expect_failure(2, "synth noise --shape 3,3,3 --seed 1 -o w.npy", "--count N is missing",
                 "MW_COUNT=3");
}

TEST_F(UsageTest, SizesAsPeopleWriteThem) {
  EXPECT_NE(run("mesh --print-config --memory 1.5g").out.find("memory = \"1.5g\"\n"),
            std::string::npos);
  make_volume();
  expect_done("mesh v.npy -o v.vtu --memory 1G --report r.json");
  EXPECT_NE(read("r.json").find("\"memory_budget_bytes\": 1073741824"), std::string::npos);
  expect_failure(2, "mesh v.npy -o w.vtu --memory 1X", "--memory 1X: expected a size such as 512M");
}

}  // namespace
}  // namespace mw::cli
