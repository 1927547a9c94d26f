// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Manual pages, from the program's own options.
#include "engine/cli/manual_page.h"

#include <algorithm>
#include <cctype>

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

std::string synopsis(const ProgramFacts& program, const CommandFacts& command) {
  std::string out = bold(program.called + " " + command.name);
  for (const FlagFacts& flag : positionals_of(command)) out += " " + italic(flag.names.front());
  return out + " [" + italic("OPTIONS") + "]\n.br\n";
}

std::string section(const ProgramFacts& program, const CommandFacts& command) {
  std::string out =
      ".SS " + plain(program.name + " " + command.name) + "\n" + plain(command.about) + ".\n";
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

std::string examples(const ProgramFacts& program) {
  std::string out = ".SH EXAMPLES\n.nf\n";
  for (const std::string& line : program.examples) out += plain(line) + "\n";
  return out + ".fi\n";
}

/// "MWMESH\-MPI", the title of a page.
std::string title(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return plain(name);
}

std::string head(const ProgramFacts& program, const std::string& version) {
  return ".TH " + title(program.name) + " 1 \"\" \"mwmesh " + version + "\" \"User Commands\"\n" +
         ".SH NAME\n" + plain(program.name) + " \\- " + plain(program.does) + "\n.SH SYNOPSIS\n";
}

}  // namespace

std::string manual_page(const ProgramFacts& program, const std::string& version) {
  std::string out = head(program, version);
  for (const CommandFacts& command : program.commands) out += synopsis(program, command);
  if (program.commands.empty()) out += bold(program.called) + "\n";
  out += ".SH DESCRIPTION\n" + plain(program.about) + "\n";
  if (program.commands.empty()) return out;
  out += ".SH SUBCOMMANDS\n";
  for (const CommandFacts& command : program.commands) out += section(program, command);
  return out + kEnvironment + kExitStatus + examples(program);
}

}  // namespace mw::cli
