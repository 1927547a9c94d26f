// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What shells complete, from the program's own options.
#include "engine/cli/completions.h"

namespace mw::cli {
namespace {

std::vector<std::string> names_of(const std::vector<CommandFacts>& commands) {
  std::vector<std::string> out;
  for (const CommandFacts& command : commands) out.push_back(command.name);
  return out;
}

/// In single quotes of bash and zsh.
std::string quoted(const std::string& text) {
  return "'" + replaced(text, "'", "'\\''") + "'";
}

/// In single quotes of fish.
std::string fish_quoted(const std::string& text) {
  return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

/// Part of zsh's _arguments.
std::string zsh_text(const std::string& text) {
  std::string out = replaced(text, "\\", "\\\\");
  for (const char* special : {"[", "]", ":"}) {
    out = replaced(out, special, std::string("\\") + special);
  }
  return out;
}

/// The function that completes.
std::string function_of(const ProgramFacts& program) {
  return "_" + program.name;
}

/// What bash does for a subcommand: the values of a flag, else flags, or the first positional.
std::string bash_case(const CommandFacts& command) {
  std::string out = "    " + command.name + ")\n      case $previous in\n";
  for (const FlagFacts& flag : flags_of(command)) {
    if (flag.value.empty()) continue;
    out += "        " + joined(flag.names, "|") + ") words='" + joined(flag.words, " ") +
           "'; flag_value=1 ;;\n";
  }
  std::string words;
  for (const FlagFacts& flag : positionals_of(command)) words += joined(flag.words, " ");
  out += "        *) positional='" + words + "' ;;\n      esac\n";
  return out + "      flags='" + joined(names_of(flags_of(command)), " ") + "' ;;\n";
}

std::string zsh_action(const FlagFacts& flag) {
  const std::string what = flag.words.empty() ? "_files" : "(" + joined(flag.words, " ") + ")";
  return ":" + zsh_text(flag.value) + ":" + what;
}

std::string zsh_spec(const FlagFacts& flag) {
  if (flag.positional) return "      " + quoted(zsh_action(flag)) + " \\\n";
  const std::string action = flag.value.empty() ? "" : zsh_action(flag);
  const std::string meaning = "[" + zsh_text(flag.help) + "]" + action;
  std::string out;
  for (const std::string& name : flag.names) {
    out.append("      ").append(quoted(name + meaning)).append(" \\\n");
  }
  return out;
}

std::string zsh_case(const CommandFacts& command) {
  std::string out = "    " + command.name + ")\n      _arguments \\\n";
  for (const FlagFacts& flag : command.flags) out += zsh_spec(flag);
  return out + "      && return ;;\n";
}

/// How a line of fish begins that is about a subcommand.
std::string fish_within(const ProgramFacts& program, const CommandFacts& command) {
  return "complete -c " + program.name + " -n '__fish_seen_subcommand_from " + command.name + "'";
}

std::string fish_flag(const FlagFacts& flag) {
  std::string out;
  for (const std::string& name : flag.names) {
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  if (!flag.value.empty()) out += " -r";
  if (!flag.words.empty()) out += " -f -a " + fish_quoted(joined(flag.words, " "));
  return out + " -d " + fish_quoted(flag.help) + "\n";
}

std::string fish_positional(const FlagFacts& flag) {
  return " -a " + fish_quoted(joined(flag.words, " ")) + " -d " + fish_quoted(flag.help) + "\n";
}

std::string fish_case(const ProgramFacts& program, const CommandFacts& command) {
  std::string out;
  for (const FlagFacts& flag : command.flags) {
    if (flag.positional && flag.words.empty()) continue;
    out += fish_within(program, command);
    out += flag.positional ? fish_positional(flag) : fish_flag(flag);
  }
  return out;
}

}  // namespace

std::string bash_completion(const ProgramFacts& program) {
  std::string out =
      "# bash completion of " + program.name + "\n" + function_of(program) +
      "() {\n"
      "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
      "  local words= flags= positional= flag_value=\n"
      "  COMPREPLY=()\n"
      "  # --flag=value is three words.\n"
      "  if [[ $current == = ]]; then\n"
      "    current=\n"
      "  elif [[ $previous == = ]] && ((COMP_CWORD > 1)); then\n"
      "    previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
      "  fi\n"
      "  if ((COMP_CWORD == 1)); then\n";
  out += "    COMPREPLY=($(compgen -W '" + joined(names_of(program.commands), " ") +
         " -h --help --version' -- \"$current\"))\n    return\n  fi\n  case ${COMP_WORDS[1]} in\n";
  for (const CommandFacts& command : program.commands) out += bash_case(command);
  return out +
         "  esac\n"
         "  if [[ -z $flag_value ]]; then\n"
         "    words=$positional\n"
         "    [[ $current == -* ]] && words=$flags\n"
         "  fi\n"
         "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o bashdefault -o default -F " +
         function_of(program) + " " + program.name + "\n";
}

std::string zsh_completion(const ProgramFacts& program) {
  std::string out = "#compdef " + program.name + "\n# zsh completion of " + program.name + "\n" +
                    function_of(program) +
                    "() {\n"
                    "  local context state state_descr line\n"
                    "  typeset -A opt_args\n"
                    "  local -a commands\n"
                    "  commands=(\n";
  for (const CommandFacts& command : program.commands) {
    out += "    " + quoted(command.name + ":" + replaced(command.about, ":", "\\:")) + "\n";
  }
  out +=
      "  )\n"
      "  _arguments -C '(- *)-h[help]' '(- *)--help[help]' '(- *)--version[version]' \\\n"
      "    '1:command:->command' '*::argument:->argument' && return\n"
      "  if [[ $state == command ]]; then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  case $words[1] in\n";
  for (const CommandFacts& command : program.commands) out += zsh_case(command);
  return out + "  esac\n}\n" + function_of(program) + " \"$@\"\n";
}

std::string fish_completion(const ProgramFacts& program) {
  const std::string complete = "complete -c " + program.name + " -n __fish_use_subcommand";
  std::string out = "# fish completion of " + program.name + "\n" + complete +
                    " -s h -l help -d 'help'\n" + complete + " -l version -d 'version'\n";
  for (const CommandFacts& command : program.commands) {
    out += complete + " -f -a " + command.name + " -d " + fish_quoted(command.about) + "\n";
    out += fish_case(program, command);
  }
  return out;
}

}  // namespace mw::cli
