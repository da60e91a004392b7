// SPDX-License-Identifier: Apache-2.0
#include "net/certificate_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "net/certificate.h"
#include "net/certificate_request.h"

namespace theatron::net {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string problem_of(const std::string& bytes) {
    try {
        (void)certificates_in(bytes);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(CertificatesIn, FindsThemAmongOtherBlocks) {
    const Certificate one = make_certificate(), other = make_certificate();
    EXPECT_THAT(certificates_in("Bag Attributes\n" + one.certificate_pem + one.private_key_pem +
                                other.certificate_pem),
                ElementsAre(one.certificate_pem, other.certificate_pem));
}

TEST(CertificatesIn, RefusesWhatHoldsNoneADamagedOneOrTooMany) {
    const Certificate one = make_certificate();
    for (const std::string& bytes : {std::string(), std::string("hello"), one.private_key_pem})
        EXPECT_THAT(problem_of(bytes), HasSubstr("holds no certificate"));
    EXPECT_THAT(problem_of("-----BEGIN CERTIFICATE-----\nAAAA\n-----END CERTIFICATE-----\n"),
                HasSubstr("damaged"));
    std::string many;
    for (std::size_t i = 0; i <= max_certificates; ++i)
        many += one.certificate_pem;
    EXPECT_THAT(problem_of(many), HasSubstr("more than"));
}

TEST(ChainOfKey, IsTheCertificateOfTheKeyAndNoOther) {
    const Certificate one = make_certificate(), other = make_certificate();
    const auto chain =
        chain_of_key({other.certificate_pem, one.certificate_pem}, one.private_key_pem);
    ASSERT_TRUE(chain);
    EXPECT_EQ(chain->pem, one.certificate_pem);
    EXPECT_TRUE(chain->has_root);
    EXPECT_THAT(chain->left_out, ElementsAre("CN=theatron"));
    EXPECT_FALSE(chain_of_key({other.certificate_pem}, one.private_key_pem));
    EXPECT_THROW((void)chain_of_key({one.certificate_pem}, "no key"), Error);
}

TEST(CertificateMistake, TellsDatesAndNamesWithTheClockOfThisMachine) {
    const Certificate one = make_certificate();
    const Validity validity = validity_of(one);
    constexpr files::UtcSeconds hour = 3600;
    EXPECT_EQ(certificate_mistake(one.certificate_pem, validity.begins + hour, "theatron"), "");
    EXPECT_THAT(certificate_mistake(one.certificate_pem, validity.begins - hour, "theatron"),
                HasSubstr("set the clock"));
    EXPECT_THAT(certificate_mistake(one.certificate_pem, validity.ends + hour, "theatron"),
                HasSubstr("was valid until"));
    EXPECT_THAT(certificate_mistake(one.certificate_pem, validity.begins + hour, "or-3.example"),
                HasSubstr("for 'theatron' and not for 'or-3.example'"));
    EXPECT_THAT(certificate_mistake("no certificate", 0, ""), HasSubstr("damaged"));
}

TEST(CertificateRequest, RefusesNamesThatAreNone) {
    const std::string key = make_key();
    for (const char* name : {"", "or 3", "a,DNS:b", "https://a", ".a", "a.", "a..b", "*.a", "a\nb"})
        EXPECT_THROW((void)certificate_request(key, {name}), Error) << name;
    EXPECT_THROW((void)certificate_request(key, {}), Error);
    EXPECT_THROW((void)certificate_request("no key", {"a"}), Error);
    EXPECT_THAT(certificate_request(key, {"or-3.example", "10.1.2.3", "fe80::1"}),
                HasSubstr("BEGIN CERTIFICATE REQUEST"));
}

}  // namespace
}  // namespace theatron::net
