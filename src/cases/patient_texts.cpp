// SPDX-License-Identifier: Apache-2.0
#include "cases/patient_texts.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "base/outside_text.h"
#include "cases/case_folder.h"
#include "cases/same_patient.h"
#include "files/private_file.h"

namespace theatron::cases {
namespace {

using nlohmann::json;

constexpr std::size_t max_patient_characters = 200;  // of one text, as on the wire
// Each of 16 series has at most 23 texts of 250 bytes.
constexpr std::size_t max_identifiers_bytes = 256 * 1024;

std::string without_blanks(std::string text) {
    text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

// A name in DICOM has three spellings between '=', and up to five parts between '^': family name,
// given name, middle name, prefix, suffix.
std::string readable_name(std::string name) {
    name = without_blanks(name.substr(0, name.find('=')));
    std::string text;
    for (std::size_t begin = 0, part = 0; begin <= name.size(); ++part) {
        const std::size_t end = std::min(name.find('^', begin), name.size());
        const std::string one = without_blanks(name.substr(begin, end - begin));
        if (!one.empty() && !text.empty())
            text += part == 1 ? ", " : " ";
        text += one;
        begin = end + 1;
    }
    return text;
}

// "19610203" as "1961-02-03"; any other text as it is.
std::string readable_date(const std::string& date) {
    const bool has_digits = date.size() == 8 && std::all_of(date.begin(), date.end(), [](char c) {
                                return c >= '0' && c <= '9';
                            });
    return has_digits ? date.substr(0, 4) + "-" + date.substr(4, 2) + "-" + date.substr(6) : date;
}

std::string text_of(const json& series, const char* name) {
    const auto found = series.find(name);
    return found != series.end()
               ? without_blanks(clean_text(found->get<std::string>(), max_patient_characters))
               : "";
}

int texts_in(const PatientTexts& patient) {
    return int(!patient.name.empty()) + int(!patient.birth_date.empty()) + int(!patient.id.empty());
}

// True for a list of series with texts, which import writes.
bool is_well_formed(const json& all) {
    if (!all.is_object() || !all.contains("series") || !all["series"].is_array())
        return false;
    const auto is_series = [](const json& one) {
        return one.is_object() && std::all_of(one.begin(), one.end(),
                                              [](const json& text) { return text.is_string(); });
    };
    return std::all_of(all["series"].begin(), all["series"].end(), is_series);
}

// A series is compared with all others: one that says little may be of each of two patients.
bool names_two_patients(const json& all) {
    std::vector<std::vector<Identifier>> patients;
    for (const json& series : all["series"]) {
        std::vector<Identifier> texts;
        for (const char* name : {"PatientName", "PatientBirthDate", "PatientID"})
            if (std::string text = text_of(series, name); !text.empty())
                texts.push_back({name, std::move(text)});
        for (const std::vector<Identifier>& other : patients)
            if (!may_be_one_patient(other, texts))
                return true;
        patients.push_back(std::move(texts));
    }
    return false;
}

}  // namespace

std::optional<PatientTexts> parse_patient_texts(const std::string& text) {
    const json all = json::parse(text, nullptr, false);
    if (!is_well_formed(all) || names_two_patients(all))
        return std::nullopt;
    PatientTexts fullest;
    std::set<std::string> dates;
    for (const json& series : all["series"]) {
        PatientTexts one{readable_name(text_of(series, "PatientName")),
                         readable_date(text_of(series, "PatientBirthDate")),
                         text_of(series, "PatientID"),
                         {}};
        if (texts_in(one) > texts_in(fullest))
            fullest = std::move(one);
        if (std::string date = readable_date(text_of(series, "StudyDate")); !date.empty())
            dates.insert(std::move(date));
    }
    if (fullest == PatientTexts{})
        return std::nullopt;
    std::string joined;
    for (const std::string& date : dates)
        joined += (joined.empty() ? "" : ", ") + date;
    fullest.study_dates = clean_text(joined, max_patient_characters);
    return fullest;
}

std::optional<PatientTexts> read_patient_texts(const std::filesystem::path& folder) {
    std::error_code failed;
    const std::filesystem::path file = folder / identifiers_name;
    const auto status = std::filesystem::symlink_status(file, failed);
    if (!std::filesystem::exists(status))
        return std::nullopt;
    if (!std::filesystem::is_regular_file(status))
        throw Error("'" + clean_text(file.string(), 300) +
                    "' is not a regular file; replace it with one, or remove it.");
    const auto text = files::read_private_file(file, files::Privacy::secret, max_identifiers_bytes);
    if (!text)
        return std::nullopt;
    const json all = json::parse(*text, nullptr, false);
    if (!is_well_formed(all))
        throw Error("'" + clean_text(file.string(), 300) +
                    "' is not what `theatron case import` writes; import the case anew, or remove "
                    "the file.");
    if (names_two_patients(all))
        throw MoreThanOnePatient("'" + clean_text(file.string(), 300) +
                                 "' names more than one patient; import the images of each by "
                                 "themselves.");
    return parse_patient_texts(*text);
}

}  // namespace theatron::cases
