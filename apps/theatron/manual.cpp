// SPDX-License-Identifier: Apache-2.0
#include "manual.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <vector>

#include "base/error.h"

namespace theatron::app {
namespace {

// A longer line of a help text is no example whose spaces matter.
constexpr std::size_t example_columns = 90;

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

// Those that help shows.
std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
    std::vector<const CLI::Option*> shown;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty())
            shown.push_back(option);
    return shown;
}

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

std::vector<std::string> names_of(const CLI::Option& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.get_snames())
        names.push_back("-" + name);
    for (const std::string& name : option.get_lnames())
        names.push_back("--" + name);
    return names;
}

// The words in "TEXT:{all,ask}"; empty: any value.
std::vector<std::string> values_of(const CLI::Option& option) {
    const std::string type = option.get_type_name();
    const std::size_t begin = type.find('{'), end = type.rfind('}');
    std::vector<std::string> values;
    if (begin == type.npos || end == type.npos || end < begin)
        return values;
    std::istringstream words(type.substr(begin + 1, end - begin - 1));
    for (std::string word; std::getline(words, word, ',');)
        values.push_back(word);
    return values;
}

std::string words_joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : between) + word;
    return text;
}

std::string roff(const std::string& text) {
    std::string safe;
    bool begins_line = true;
    for (const char c : text) {
        // At the beginning of a line these are requests.
        if (begins_line && (c == '.' || c == '\''))
            safe += "\\&";
        if (c == '\\')
            safe += "\\e";
        else if (c == '-')
            safe += "\\-";
        else
            safe += c;
        begins_line = c == '\n';
    }
    return safe;
}

// Lines as they stand, long ones as paragraphs.
std::string roff_lines(const std::string& text) {
    std::string page;
    bool is_plain = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const bool fits = line.size() <= example_columns;
        if (fits != is_plain)
            page += fits ? ".PP\n.nf\n" : ".fi\n";
        is_plain = fits;
        if (!fits)
            page += ".PP\n" +
                    roff(line.substr(std::min(line.find_first_not_of(' '), line.size()))) + "\n";
        else
            page += line.empty() ? ".sp\n" : roff(line) + "\n";
    }
    return page + (is_plain ? ".fi\n" : "");
}

std::string roff_options(const CLI::App& command) {
    std::string page;
    for (const CLI::Option* option : shown_options(command)) {
        page += ".TP\n";
        if (option->get_positional()) {
            page += "\\fI" + roff(option->get_name(true)) + "\\fR";
        } else {
            page += "\\fB" + roff(words_joined(names_of(*option), ", ")) + "\\fR";
            const auto values = values_of(*option);
            if (!values.empty())
                page += " " + roff(words_joined(values, "|"));
            else if (takes_value(*option))
                page += " \\fI" + roff(option->get_type_name()) + "\\fR";
        }
        page += "\n" + roff(option->get_description());
        if (!option->get_default_str().empty())
            page += " (default: " + roff(option->get_default_str()) + ")";
        page += "\n";
    }
    return page;
}

std::string synopsis(const std::string& name, const CLI::App& command) {
    std::string line = "\\fB" + roff(name) + "\\fR [\\fIOPTION\\fR]...";
    for (const CLI::Option* option : shown_options(command))
        if (option->get_positional())
            line += option->get_required() ? " \\fI" + roff(option->get_name(true)) + "\\fR"
                                           : " [\\fI" + roff(option->get_name(true)) + "\\fR]";
    if (!commands_of(command).empty())
        line += " \\fICOMMAND\\fR ...";
    return line + "\n";
}

// The first sentence, as a part of a text in '...' that zsh's completion takes apart at ':' and
// ']'.
std::string zsh_help(const std::string& description) {
    std::string line = description.substr(0, description.find_first_of(";\n"));
    line = line.substr(0, line.find(". "));
    if (line.ends_with('.'))
        line.pop_back();
    std::string text;
    for (const char c : line) {
        if (c == ':')
            text += "\\:";
        else if (c == '\'')
            text += "'\\''";
        else if (c == '[' || c == ']')
            text += c == '[' ? '(' : ')';
        else if (c != '\\')
            text += c;
    }
    return text;
}

// The value of an option for zsh's _arguments.
std::string zsh_value(const CLI::Option& option) {
    const auto values = values_of(option);
    return values.empty() ? ":value:_files" : ":value:(" + words_joined(values, " ") + ")";
}

std::string zsh_arguments(const CLI::App& command) {
    std::string text = "_arguments";
    for (const CLI::Option* option : shown_options(command)) {
        if (option->get_positional())
            continue;
        // An option that may be given again is offered again.
        const bool repeats = option->get_items_expected_max() > 1;
        for (const std::string& name : names_of(*option))
            text += " \\\n        '" + std::string(repeats ? "*" : "") + name + "[" +
                    zsh_help(option->get_description()) + "]" +
                    (takes_value(*option) ? zsh_value(*option) : "") + "'";
    }
    return text + " \\\n        '*:file:_files'";
}

std::string zsh_commands(const CLI::App& app) {
    std::string text = "commands=(";
    for (const CLI::App* command : commands_of(app))
        text +=
            "\n        '" + command->get_name() + ":" + zsh_help(command->get_description()) + "'";
    return text + ")\n        _describe command commands";
}

std::string bash_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(app))
        names.push_back(command->get_name());
    return words_joined(names, " ");
}

std::string bash_options(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : shown_options(command))
        for (const std::string& name : names_of(*option))
            names.push_back(name);
    return words_joined(names, " ");
}

// Cases of bash: the command, as the beginning of a quoted pattern, and the option before choose
// the words that may follow.
std::string bash_cases(const std::string& pattern, const CLI::App& command) {
    std::string text;
    for (const CLI::Option* option : shown_options(command))
        if (const auto values = values_of(*option); !values.empty())
            for (const std::string& name : names_of(*option))
                text += "        " + pattern + " " + name + "') words='" +
                        words_joined(values, " ") + "' ;;\n";
    return text;
}

void write_manual_file(const std::filesystem::path& path, const std::string& text) {
    std::ofstream out(path);
    out << text;
    if (!out.flush())
        throw Error("Cannot write '" + path.string() + "'.");
}

}  // namespace

std::string manual_page(const CLI::App& app, const CLI::App& command, const std::string& version) {
    const bool is_whole = &app == &command;
    const std::string name = is_whole ? "theatron" : "theatron-" + command.get_name(),
                      words = is_whole ? "theatron" : "theatron " + command.get_name();
    const std::string description = command.get_description();
    const std::string first_line = description.substr(0, description.find('\n'));
    std::string page = ".\\\" Written by the program itself.\n.TH \"" + name +
                       "\" 1 \"\" \"Theatron " + version +
                       "\" \"Theatron\"\n.nh\n.ad l\n.SH NAME\n" + roff(name) + " \\- " +
                       roff(first_line) + "\n.SH SYNOPSIS\n" + synopsis(words, command) +
                       ".SH DESCRIPTION\n" + roff_lines(description);
    page += ".SH OPTIONS\n" + roff_options(command);
    const auto commands = commands_of(command);
    if (!commands.empty())
        page += ".SH COMMANDS\n";
    for (const CLI::App* sub : commands) {
        if (is_whole) {
            page += ".TP\n\\fB" + roff(name + "-" + sub->get_name()) + "\\fR(1)\n" +
                    roff(sub->get_description()) + "\n";
        } else {
            page += ".SS " + roff(words + " " + sub->get_name()) + "\n" +
                    synopsis(words + " " + sub->get_name(), *sub) + ".PP\n" +
                    roff(sub->get_description()) + "\n" + roff_options(*sub) +
                    roff_lines(sub->get_footer());
        }
    }
    if (!command.get_footer().empty())
        page += ".SH NOTES\n" + roff_lines(command.get_footer());
    return page + ".SH SEE ALSO\n\\fBtheatron\\fR(1)\n";
}

std::string bash_completion(const CLI::App& app) {
    std::string options, values, subcommands;
    for (const CLI::App* command : commands_of(app)) {
        const std::string name = command->get_name();
        if (const std::string names = bash_names(*command); !names.empty())
            subcommands += "        " + name + ") words='" + names + "' ;;\n";
        for (const CLI::App* sub : commands_of(*command)) {
            options += "        '" + name + " " + sub->get_name() + "') words='" +
                       bash_options(*sub) + "' ;;\n";
            values += bash_cases("'" + name + " " + sub->get_name(), *sub);
        }
        options += "        '" + name + " '*) words='" + bash_options(*command) + "' ;;\n";
        values += bash_cases("'" + name + " '*'", *command);
    }
    std::string text =
        "# bash completion for theatron, written by the program itself.\n"
        "_theatron() {\n"
        "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=''\n"
        "    local command=${COMP_WORDS[1]} second=${COMP_WORDS[2]}\n"
        "    COMPREPLY=()\n"
        "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
        "        COMPREPLY=($(compgen -W '" +
        bash_names(app) + " " + bash_options(app) +
        "' -- \"$current\"))\n"
        "        return\n"
        "    fi\n"
        "    case \"$second\" in -*) second='' ;; esac\n"
        "    if [ \"$COMP_CWORD\" -eq 2 ]; then\n"
        "        case \"$command\" in\n" +
        subcommands +
        "        esac\n"
        "    fi\n"
        "    if [ -z \"$words\" ]; then\n"
        "        case \"$command $second $before\" in\n" +
        values +
        "        esac\n"
        "    fi\n"
        "    if [ -z \"$words\" ]; then\n"
        "        case \"$current\" in\n"
        "        -*) case \"$command $second\" in\n" +
        options +
        "            esac ;;\n"
        "        esac\n"
        "    fi\n"
        "    [ -z \"$words\" ] || COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
        "}\n"
        "complete -o default -F _theatron theatron\n";
    return text;
}

std::string zsh_completion(const CLI::App& app) {
    std::string text =
        "#compdef theatron\n"
        "# zsh completion for theatron, written by the program itself.\n"
        "_theatron() {\n"
        "    local -a commands\n"
        "    if (( CURRENT == 2 )); then\n        " +
        zsh_commands(app) +
        "\n        return\n"
        "    fi\n"
        "    shift words\n"
        "    (( CURRENT -= 1 ))\n"
        "    case $words[1] in\n";
    for (const CLI::App* command : commands_of(app)) {
        text += "    " + command->get_name() + ")\n";
        const auto subs = commands_of(*command);
        if (!subs.empty()) {
            text += "        if (( CURRENT == 2 )); then\n        " + zsh_commands(*command) +
                    "\n        return\n        fi\n"
                    "        shift words\n        (( CURRENT -= 1 ))\n        case $words[1] in\n";
            for (const CLI::App* sub : subs)
                text += "        " + sub->get_name() + ") " + zsh_arguments(*sub) + " ;;\n";
            text += "        esac ;;\n";
        } else {
            text += "        " + zsh_arguments(*command) + " ;;\n";
        }
    }
    return text + "    esac\n}\n_theatron \"$@\"\n";
}

void write_manual(const CLI::App& app, const std::string& version,
                  const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder / "man1");
    write_manual_file(folder / "man1/theatron.1", manual_page(app, app, version));
    for (const CLI::App* command : commands_of(app))
        write_manual_file(folder / "man1" / ("theatron-" + command->get_name() + ".1"),
                          manual_page(app, *command, version));
    write_manual_file(folder / "theatron.bash", bash_completion(app));
    write_manual_file(folder / "_theatron", zsh_completion(app));
}

}  // namespace theatron::app
