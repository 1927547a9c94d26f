// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// The manual page, from the program's own options.
#include "engine/cli/manual_page.h"

namespace mw::cli {
namespace {

/// Text that troff takes as it is: a line begins with no dot or quote, '-' is a hyphen-minus.
std::string plain(const std::string& text) {
  std::string out = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  if (out.starts_with(".") || out.starts_with("'")) out.insert(0, "\\&");
  return replaced(replaced(out, "\n.", "\n\\&."), "\n'", "\n\\&'");
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string flag_entry(const FlagFacts& flag) {
  std::string head;
  for (const std::string& name : flag.names) head += (head.empty() ? "" : ", ") + bold(name);
  if (!flag.value.empty() && flag.value != flag.names.front()) head += " " + italic(flag.value);
  return ".TP\n" + head + "\n" + plain(flag.help) + "\n";
}

std::string synopsis(const CommandFacts& command) {
  std::string out = bold("mwmesh " + command.name);
  for (const FlagFacts& flag : positionals_of(command)) out += " " + italic(flag.names.front());
  return out + " [" + italic("OPTIONS") + "]\n.br\n";
}

std::string section(const CommandFacts& command) {
  std::string out = ".SS " + plain("mwmesh " + command.name) + "\n" + plain(command.about) + ".\n";
  for (const FlagFacts& flag : command.flags) out += flag_entry(flag);
  if (!command.footer.empty()) out += ".PP\n" + plain(command.footer) + "\n";
  return out;
}

constexpr const char* kEnvironment =
    ".SH ENVIRONMENT\n"
    "The options of\n.B mwmesh mesh\nand those that share their names may be set by variables: "
    "\\fBMW_EDGE_VARIANCE\\fR for \\fB\\-\\-edge\\-variance\\fR.\n"
    "A variable that begins with MW_ and that no subcommand reads is an error.\n";

constexpr const char* kExitStatus =
    ".SH EXIT STATUS\n"
    ".TP\n0\ndone\n"
    ".TP\n1\ninternal error\n"
    ".TP\n2\nusage or config\n"
    ".TP\n3\nbad input\n"
    ".TP\n4\nout of a resource: memory, disk\n"
    ".TP\n5\na check failed\n"
    ".TP\n75\ninterrupted, and \\fB\\-\\-resume\\fR can go on\n"
    ".TP\n130\ninterrupted\n";

constexpr const char* kExamples =
    ".SH EXAMPLES\n"
    ".nf\n"
    "mwmesh mesh brain.nii.gz \\-o brain.vtu \\-\\-report brain.json\n"
    "mwmesh verify brain.nii.gz brain.vtu\n"
    "mwmesh info brain.vtu\n"
    ".fi\n";

}  // namespace

std::string manual_page(const std::vector<CommandFacts>& commands, const std::string& version) {
  std::string out = ".TH MWMESH 1 \"\" \"mwmesh " + version + "\" \"User Commands\"\n" +
                    ".SH NAME\nmwmesh \\- labelled voxel volumes to verified tetrahedral meshes\n" +
                    ".SH SYNOPSIS\n";
  for (const CommandFacts& command : commands) out += synopsis(command);
  out += ".SH DESCRIPTION\nFrom a labelled voxel volume to a verified tetrahedral mesh.\n";
  out += ".SH SUBCOMMANDS\n";
  for (const CommandFacts& command : commands) out += section(command);
  return out + kEnvironment + kExitStatus + kExamples;
}

}  // namespace mw::cli
