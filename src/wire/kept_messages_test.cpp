// SPDX-License-Identifier: Apache-2.0
// Control messages as programs of earlier versions sent them are read as they were meant
// (tests/vectors/README.md): each line of tests/vectors/*/messages.txt has a direction, the number
// of the kind, the bytes and the text of the fields. For the file of a new version run this test
// with THEATRON_WRITE_VECTORS=tests/vectors/VERSION.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "base/hex_text.h"
#include "wire/control.h"

namespace theatron::wire {
namespace {

template <class T>
concept HasFields = requires(T& value) {
    T::fields(value, [](auto&&...) {});
};

// The values of a message in the order of its fields: "(3 3 'secret' x0a0b (1 2))". Zeros and empty
// values are "-", and those at a table's end are left out: fields that a later version appended do
// not change the text of an earlier message.
class FieldTexts {
public:
    explicit FieldTexts(std::vector<std::string>& texts) : texts_(texts) {}
    template <class T>
    void operator()(const T& value, std::size_t = 0) {
        texts_.push_back(text_of_field(value));
    }

private:
    template <class T>
    static std::string text_of_field(const T& value) {
        if constexpr (HasFields<T>)
            return text_of_table(value);
        else if constexpr (std::is_same_v<T, TimePoint>)
            return text_of_field(to_us(value));
        else if constexpr (std::is_same_v<T, Duration>)
            return text_of_field(value.count());
        else if constexpr (std::is_enum_v<T>)
            return text_of_field(std::underlying_type_t<T>(value));
        else if constexpr (std::is_arithmetic_v<T>)
            return value == T() ? "-" : std::to_string(value);
        else if constexpr (std::is_same_v<T, std::string>)
            return value.empty() ? "-" : "'" + value + "'";
        else if constexpr (std::is_same_v<T, Bytes>)
            return value.empty() ? "-" : "x" + hex_text(value);
        else
            return text_of_list(value);
    }
    template <class T>
    static std::string text_of_list(const std::vector<T>& list) {
        std::string text;
        for (const T& one : list)
            text += (text.empty() ? "[" : " ") + text_of_field(one);
        return list.empty() ? "-" : text + "]";
    }
    template <class T>
    static std::string text_of_table(const T& table) {
        std::vector<std::string> texts;
        T::fields(table, FieldTexts(texts));
        while (!texts.empty() && texts.back() == "-")
            texts.pop_back();
        std::string text;
        for (const std::string& one : texts)
            text += (text.empty() ? "(" : " ") + one;
        return text.empty() ? "-" : text + ")";
    }

    std::vector<std::string>& texts_;
};

template <class Union>
std::string text_of_message(const Union& message) {
    std::vector<std::string> texts;
    std::visit([&](const auto& m) { FieldTexts{texts}(m); }, message);
    return texts.at(0);
}

// Gives each field of a message another value that its kind allows.
struct FilledFields {
    int& last;
    template <class T>
    requires HasFields<T>
    void operator()(T& table) { T::fields(table, FilledFields{last}); }
    template <class T>
    requires(!HasFields<T>) void operator()(T& value) {
        // A small enumeration has the values 0 and 1 at least.
        if constexpr (std::is_enum_v<T> && sizeof(T) == 1)
            value = T(1);
        else if constexpr (std::is_same_v<T, TimePoint>)
            value = from_us(++last);
        else if constexpr (std::is_same_v<T, bool>)
            value = true;
        else if constexpr (std::is_floating_point_v<T>)
            value = T(++last) + T(0.5);
        else
            value = T(++last);
    }
    void operator()(std::string& text, std::size_t) { text = "text " + std::to_string(++last); }
    void operator()(Bytes& bytes, std::size_t limit) {
        // As long as a hash, a secret or the id of a person, where it is one.
        bytes.resize(std::min<std::size_t>(limit, 32));
        for (std::byte& one : bytes)
            one = std::byte(++last & 255);
    }
    template <class T>
    void operator()(std::vector<T>& list, std::size_t limit) {
        list.resize(2);
        for (T& one : list)
            if constexpr (std::is_same_v<T, std::string>)
                (*this)(one, limit);
            else
                (*this)(one);
    }
};

template <class Union, std::size_t kind = 0>
void write_messages(std::ostream& out, const char* direction) {
    if constexpr (kind < std::variant_size_v<Union>) {
        std::variant_alternative_t<kind, Union> message;
        int last = 0;
        FilledFields{last}(message);
        out << direction << " " << kind + 1 << " " << hex_text(encode(Union(message))) << " "
            << text_of_message(Union(message)) << "\n";
        write_messages<Union, kind + 1>(out, direction);
    }
}

// The text of the message if it is of this kind, or the reason why it is not read.
template <class Union>
std::string read_again(const Result<Union>& message, std::size_t kind) {
    if (!message)
        return std::string(to_text(message.error()));
    return message->index() + 1 == kind ? text_of_message(*message) : "of another kind";
}

std::vector<std::filesystem::path> kept_files() {
    std::vector<std::filesystem::path> files;
    for (const auto& version : std::filesystem::directory_iterator("tests/vectors"))
        if (version.is_directory())
            files.push_back(version.path() / "messages.txt");
    return files;
}

TEST(KeptMessages, OfEveryVersionAreReadAsTheyWereMeant) {
    if (const char* folder = std::getenv("THEATRON_WRITE_VECTORS")) {
        std::ofstream out(std::filesystem::path(folder) / "messages.txt", std::ios::binary);
        write_messages<ToHost>(out, "to_host");
        write_messages<ToParticipant>(out, "to_participant");
        ASSERT_TRUE(out.flush()) << folder;
    }
    EXPECT_FALSE(kept_files().empty());
    for (const std::filesystem::path& file : kept_files()) {
        std::ifstream in(file, std::ios::binary);
        std::map<std::string, std::set<std::size_t>> kinds;
        for (std::string line; std::getline(in, line);) {
            std::istringstream words(line);
            std::string direction, digits, meant;
            std::size_t kind = 0;
            words >> direction >> kind >> digits >> std::ws;
            std::getline(words, meant);
            const auto bytes = bytes_of_hex(digits);
            ASSERT_TRUE(bytes && !meant.empty()) << file << ": " << line;
            EXPECT_EQ(direction == "to_host" ? read_again(decode_to_host(*bytes), kind)
                                             : read_again(decode_to_participant(*bytes), kind),
                      meant)
                << file << ": " << direction << " " << kind;
            kinds[direction].insert(kind);
        }
        // Version 0.1.0 had these; none was ever taken away.
        EXPECT_GE(kinds["to_host"].size(), 18u) << file;
        EXPECT_GE(kinds["to_participant"].size(), 29u) << file;
    }
}

}  // namespace
}  // namespace theatron::wire
