// SPDX-License-Identifier: Apache-2.0
#include "cases/patient_words.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "cases/folded_text.h"

namespace theatron::cases {
namespace {

constexpr std::size_t least_anywhere = 4, least_at_ends = 3, least_as_word = 2;

// Words in the names of organs, vessels, findings and series.
constexpr std::string_view harmless_words[] = {
    "abdomen",    "abdominal",   "adrenal",     "adrenals",  "angle",    "annular",    "annulus",
    "anterior",   "aorta",       "aortic",      "arm",       "artefact", "arterial",   "arterie",
    "arterien",   "arteries",    "artery",      "ascending", "atrial",   "atrium",     "axial",
    "axis",       "bifurcation", "bile",        "bladder",   "blood",    "bone",       "bones",
    "brain",      "branch",      "carina",      "carotid",   "caudate",  "caval",      "cava",
    "celiac",     "central",     "chest",       "colon",     "common",   "contrast",   "coronal",
    "coronary",   "cortex",      "cranial",     "cyst",      "delayed",  "descending", "distal",
    "dorsal",     "duct",        "duodenum",    "esophagus", "external", "femoral",    "femur",
    "fundus",     "gallbladder", "gallenblase", "ganglion",  "gastric",  "gland",      "haut",
    "head",       "heart",       "hepatic",     "herz",      "iliac",    "inferior",   "internal",
    "kidney",     "kidneys",     "knochen",     "label",     "lateral",  "leaf",       "leber",
    "left",       "lesion",      "lesions",     "line",      "linear",   "links",      "liver",
    "lobe",       "lobes",       "long",        "lower",     "lung",     "lunge",      "lungs",
    "lymph",      "magen",       "main",        "mandible",  "marker",   "mass",       "medial",
    "mesenteric", "metastases",  "metastasis",  "middle",    "milz",     "muscle",     "native",
    "nerve",      "niere",       "nieren",      "node",      "nodes",    "organ",      "organs",
    "pancreas",   "parenchyma",  "pelvis",      "phase",     "plane",    "planes",     "portal",
    "posterior",  "prostate",    "proximal",    "pulmonary", "rectum",   "rechts",     "rectal",
    "renal",      "resection",   "right",       "sagittal",  "scan",     "segment",    "segments",
    "sella",      "series",      "serie",       "shell",     "short",    "skin",       "skull",
    "sleeve",     "slice",       "spine",       "spleen",    "splenic",  "stent",      "sternum",
    "stomach",    "superior",    "surface",     "thorax",    "thyroid",  "tibia",      "tissue",
    "trachea",    "tree",        "trunk",       "tumor",     "tumors",   "tumour",     "tumours",
    "upper",      "ureter",      "vascular",    "vein",      "veins",    "vena",       "vene",
    "venen",      "venous",      "ventral",     "ventricle", "vessel",   "vessels",    "volume",
};

// Words behind which small numbers count things.
constexpr std::string_view counting_words[] = {
    "image",  "label", "lesion",  "lobe",  "metastasis", "node",    "number",
    "part",   "phase", "picture", "point", "seg",        "segment", "serie",
    "series", "slice", "teil",    "tumor", "tumour",
};

// The beginnings of the names of months in English, German, French, Spanish, Italian, Portuguese
// and Dutch, folded; by month.
struct MonthName {
    std::string_view begins;
    int month;
};
constexpr MonthName month_names[] = {
    {"jan", 1},  {"gen", 1},  {"ene", 1},  {"feb", 2},  {"fev", 2},  {"mar", 3},
    {"mrz", 3},  {"maer", 3}, {"maa", 3},  {"mrt", 3},  {"apr", 4},  {"avr", 4},
    {"abr", 4},  {"may", 5},  {"mai", 5},  {"mei", 5},  {"mag", 5},  {"jun", 6},
    {"juin", 6}, {"giu", 6},  {"jul", 7},  {"juil", 7}, {"lug", 7},  {"aug", 8},
    {"aou", 8},  {"ago", 8},  {"sep", 9},  {"set", 9},  {"oct", 10}, {"okt", 10},
    {"ott", 10}, {"out", 10}, {"nov", 11}, {"dec", 12}, {"dez", 12}, {"dic", 12},
};

template <typename Words>
bool is_one_of(const Words& words, std::string_view word) {
    return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

bool is_number(std::string_view word) {
    return !word.empty() &&
           std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool is_ascii(std::string_view word) {
    return std::all_of(word.begin(), word.end(), [](char c) { return std::uint8_t(c) < 0x80; });
}

// The word is a number of at most four digits with this value.
bool has_value(const std::string& word, int value) {
    return is_number(word) && word.size() <= 4 && std::stoi(word) == value;
}

bool is_year(const std::string& word, int year) {
    return (word.size() == 4 && has_value(word, year)) ||
           (word.size() == 2 && has_value(word, year % 100));
}

bool is_month(const std::string& word, int month) {
    if (word.size() <= 2)
        return has_value(word, month);
    return std::any_of(std::begin(month_names), std::end(month_names), [&](const MonthName& name) {
        return name.month == month && word.starts_with(name.begins);
    });
}

bool is_day(const std::string& word, int day) {
    return word.size() <= 2 && has_value(word, day);
}

// "3.2.61", "Feb 3rd, 1961", "1961 Februar 03".
bool has_date(std::string_view text, int year, int month, int day) {
    constexpr std::string_view between[] = {"st", "nd", "rd", "th", "of", "de", "den", "the", "er"};
    std::vector<std::string> words = folded_words(text, Umlaut::as_one_letter, Split::at_changes);
    std::erase_if(words, [&](const std::string& word) { return is_one_of(between, word); });
    for (std::size_t i = 0; i + 2 < words.size(); ++i) {
        const std::string &a = words[i], &b = words[i + 1], &c = words[i + 2];
        if ((is_day(a, day) && is_month(b, month) && is_year(c, year)) ||
            (is_month(a, month) && is_day(b, day) && is_year(c, year)) ||
            (is_year(a, year) && is_month(b, month) && is_day(c, day)))
            return true;
    }
    return false;
}

// True if words that follow each other give the identifier, which may be parted.
bool has_identifier(const std::vector<std::string>& words, const std::string& identifier) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        std::string run;
        for (std::size_t k = i; k < words.size() && run.size() < identifier.size(); ++k)
            run += words[k];
        const bool counts =
            i > 0 && is_number(identifier) && is_one_of(counting_words, words[i - 1]);
        if (run == identifier && !counts)
            return true;
    }
    return false;
}

// The values of a text, which are parted by backslashes.
std::vector<std::string_view> values_of(std::string_view text) {
    std::vector<std::string_view> values;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\\', at), text.size());
        values.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return values;
}

}  // namespace

void PatientWords::add_name(const std::string& text) {
    for (const Umlaut umlaut : {Umlaut::as_one_letter, Umlaut::as_two_letters})
        for (const std::string_view value : values_of(text)) {
            const auto words = folded_words(value, umlaut, Split::at_separators);
            for (const std::string& word : words) {
                if (word.size() >= least_anywhere || !is_ascii(word))
                    names_.push_back(word);
                else if (word.size() >= least_at_ends)
                    at_ends_.push_back(word);
                else if (word.size() >= least_as_word)
                    whole_.push_back(word);
            }
            // Short names are written as one: "xuli".
            for (std::size_t i = 0; i < words.size(); ++i)
                for (std::size_t k = 0; k < words.size(); ++k) {
                    const std::size_t shorter = std::min(words[i].size(), words[k].size()),
                                      longer = std::max(words[i].size(), words[k].size());
                    if (i == k || shorter >= least_at_ends || longer > least_at_ends)
                        continue;
                    const std::string both = words[i] + words[k];
                    if (both.size() >= least_as_word + 1)
                        (both.size() >= least_anywhere ? at_ends_ : whole_).push_back(both);
                }
        }
}

// A number counts as a whole: its parts are in many texts.
void PatientWords::add_identifier(const std::string& text) {
    for (const Umlaut umlaut : {Umlaut::as_one_letter, Umlaut::as_two_letters})
        for (const std::string_view value : values_of(text)) {
            const std::string number = joined(folded_words(value, umlaut, Split::at_separators));
            if (number.size() >= least_anywhere)
                numbers_.push_back(number);
            else if (number.size() >= least_as_word)
                short_numbers_.push_back(number);
        }
}

void PatientWords::add_birth_date(const std::string& value) {
    if (value.size() != 8 || !is_number(value))
        return;
    const std::string year = value.substr(0, 4), month = value.substr(4, 2),
                      day = value.substr(6, 2), short_year = year.substr(2);
    for (const std::string& date :
         {year + month + day, day + month + year, month + day + year, short_year + month + day,
          day + month + short_year, month + day + short_year})
        numbers_.push_back(date);
    born_.push_back({std::stoi(year), std::stoi(month), std::stoi(day)});
}

void PatientWords::add(const Identifier& identifier) {
    if (identifier.name == "PatientName" || identifier.name == "OtherPatientNames" ||
        identifier.name == "PatientBirthName" || identifier.name == "PatientMotherBirthName" ||
        identifier.name == "ResponsiblePerson")
        add_name(identifier.value);
    else if (identifier.name == "PatientID" || identifier.name == "OtherPatientIDs" ||
             identifier.name == "AccessionNumber" || identifier.name == "AdmissionID" ||
             identifier.name == "PatientAddress" || identifier.name == "PatientTelephoneNumbers")
        add_identifier(identifier.value);
    else if (identifier.name == "PatientBirthDate")
        add_birth_date(identifier.value);
}

bool PatientWords::is_harmless(const std::string& word) const {
    return is_one_of(harmless_words, word) && !is_one_of(names_, word) &&
           !is_one_of(at_ends_, word) && !is_one_of(whole_, word);
}

bool PatientWords::has_name(const std::vector<std::string>& words) const {
    std::string run;  // of words that are not harmless
    for (const std::string& word : words) {
        if (is_harmless(word)) {
            run.clear();
            continue;
        }
        run += word;
        for (const std::string& name : names_)
            if (run.find(name) != std::string::npos)
                return true;
        for (const std::string& name : at_ends_)
            if (word.starts_with(name) || word.ends_with(name))
                return true;
        if (is_one_of(whole_, word))
            return true;
    }
    return false;
}

bool PatientWords::occur_in(const std::string& text) const {
    for (const Date& born : born_)
        if (has_date(text, born.year, born.month, born.day))
            return true;
    for (const Umlaut umlaut : {Umlaut::as_one_letter, Umlaut::as_two_letters}) {
        const std::string all = joined(folded_words(text, umlaut, Split::at_separators));
        for (const std::string& number : numbers_)
            if (all.find(number) != std::string::npos)
                return true;
        for (const Split split : {Split::at_separators, Split::at_changes}) {
            const std::vector<std::string> words = folded_words(text, umlaut, split);
            if (has_name(words))
                return true;
            for (const std::string& number : short_numbers_)
                if (has_identifier(words, number))
                    return true;
        }
    }
    return false;
}

}  // namespace theatron::cases
