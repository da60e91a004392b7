// SPDX-License-Identifier: Apache-2.0
// The texts by which people recognise a patient, from a case's file of identifiers
// (docs/formats/case.md). They are shown to those who may know them, and kept nowhere else.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/error.h"

namespace theatron::cases {

// As people read them: "Doe, Jane Mary", "1961-02-03", "AB-4711". A text that is not known is
// empty; one of the first three is not.
struct PatientTexts {
    std::string name, birth_date, id;
    std::string
        study_dates;  // of all series of this patient, separated by commas, the oldest first
    bool operator==(const PatientTexts&) const = default;
};

// Such a case is not offered: nobody could tell whose images they see.
struct MoreThanOnePatient : Error {
    using Error::Error;
};

// The content of the file: the texts of one of its series, the first that has most of them.
// nullopt: it names no patient, names more than one, or is not what import writes. Safe for
// untrusted input.
std::optional<PatientTexts> parse_patient_texts(const std::string& json);

// nullopt if the case has no such file, or it names no patient. Throws Error with one sentence, in
// which nothing of the file's content occurs, if others can read the file, or it is damaged;
// MoreThanOnePatient if it names more than one patient.
std::optional<PatientTexts> read_patient_texts(const std::filesystem::path& folder);

}  // namespace theatron::cases
