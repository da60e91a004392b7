// SPDX-License-Identifier: Apache-2.0
#include <charconv>

#include "study/study_run.h"

namespace theatron::study {
namespace {

constexpr std::string_view journal_word = "theatron-study-1";

template <class Number>
bool read_number(std::string_view text, Number& number, int base = 10) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
    return error == std::errc() && end == text.data() + text.size();
}

// Parts between tabs.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t tab = line.find('\t');
        fields.push_back(line.substr(0, tab));
        if (tab == line.npos)
            return fields;
        line.remove_prefix(tab + 1);
    }
}

bool is_step_name(std::string_view text) {
    return !text.empty() && text.size() <= 120 &&
           text.find_first_not_of(
               "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
               "0123456789-_.") == text.npos;
}

bool read_entry(std::string_view line, JournalEntry& entry) {
    const auto fields = fields_of(line);
    if (fields.size() != 5 || !read_number(fields[0], entry.at_ms) ||
        !read_number(fields[1], entry.took_ms) || entry.at_ms < 0 || entry.took_ms < 0 ||
        !is_step_name(fields[2]))
        return false;
    entry.step = fields[2];
    if (fields[3] != "-") {
        int value = 0;
        if (!read_number(fields[3], value))
            return false;
        entry.value = value;
    }
    entry.late = fields[4] == "late";
    return entry.late || fields[4] == "ok";
}

bool read_head(std::string_view line, Journal& journal) {
    const auto fields = fields_of(line);
    journal.participant = fields.size() == 3 ? fields[1] : "";
    return fields.size() == 3 && fields[0] == journal_word && participant_number(fields[1]) &&
           fields[2].size() == 16 && read_number(fields[2], journal.hash, 16);
}

}  // namespace

ReadJournal parse_journal(std::string_view text) {
    ReadJournal read;
    if (text.size() > max_journal_bytes) {
        read.problem = "it is larger than a journal can be";
        return read;
    }
    std::int64_t before = 0;
    while (true) {
        const std::size_t end = text.find('\n');
        if (end == text.npos)
            return read;
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end + 1);
        ++read.line;
        if (read.line == 1) {
            if (!read_head(line, read.journal)) {
                read.problem = "it does not begin as the journal of a study does";
                return read;
            }
        } else {
            JournalEntry entry;
            if (!read_entry(line, entry) || entry.at_ms < before) {
                read.problem = "the line is no entry of a journal";
                return read;
            }
            before = entry.at_ms;
            read.journal.entries.push_back(std::move(entry));
        }
        read.journal.whole_bytes += end + 1;
    }
}

std::string hash_text(std::uint64_t hash) {
    char digits[16];
    const auto end = std::to_chars(digits, digits + sizeof(digits), hash, 16).ptr;
    const std::string hex(digits, end);
    return std::string(16 - hex.size(), '0') + hex;
}

std::string journal_head(const std::string& participant, std::uint64_t hash) {
    return std::string(journal_word) + "\t" + participant + "\t" + hash_text(hash) + "\n";
}

std::string journal_line(const JournalEntry& entry) {
    return std::to_string(entry.at_ms) + "\t" + std::to_string(entry.took_ms) + "\t" + entry.step +
           "\t" + (entry.value ? std::to_string(*entry.value) : "-") + "\t" +
           (entry.late ? "late" : "ok") + "\n";
}

}  // namespace theatron::study
