// SPDX-License-Identifier: Apache-2.0
// The certificates of a running host, and what its links say of them.
#include "base/error.h"
#include "base/log.h"
#include "host/host_impl.h"

namespace theatron::host {
namespace {

// A host that people cannot reach as its options say does not start.
void check_access(const HostOptions& options) {
    const bool is_behind_proxy = !options.proxies.empty();
    if (options.insists_on_https && options.certificate.empty())
        throw Error(
            "--hsts forbids browsers to go on after a warning, so it needs a certificate that "
            "they trust: add --certificate and --key, or leave it out.");
    if (is_behind_proxy && (options.public_name.empty() || options.proxy_certificate.empty()))
        throw Error(
            "--behind-proxy needs --public-name, the name in the links, and --proxy-certificate, "
            "the proxy's certificate as a PEM file, which native participants compare.");
    if (!is_behind_proxy && !options.proxy_certificate.empty())
        throw Error("--proxy-certificate is that of a proxy; add --behind-proxy ADDRESS.");
    if (!options.public_name.empty() && !options.link_host.empty())
        throw Error("--public-name is also the name in the links; leave out --link-host.");
}

}  // namespace

net::Access Host::Impl::open_access(const HostOptions& options) {
    constexpr std::uint16_t https_port = 443;
    check_access(options);
    if (options.certificate.empty())
        certificate.emplace(net::load_or_make_certificate(state_folder), state_folder);
    else
        certificate.emplace(net::CertificateFiles(options.certificate, options.key));
    if (!options.proxy_certificate.empty())
        proxy_certificate.emplace(net::CertificateFiles(options.proxy_certificate, ""));

    net::Access access;
    access.proxies = net::Proxies(options.proxies);
    access.insists_on_https = options.insists_on_https;
    if (!options.public_name.empty())
        access.name = net::parse_public_name(
            options.public_name, access.proxies.empty() ? options.listen.port : https_port);
    return access;
}

void Host::Impl::note_link(const HostOptions& options, const net::Access& access) {
    const bool everywhere = options.listen.address == "0.0.0.0" || options.listen.address == "::";
    link.host = access.name                  ? access.name->name
                : !options.link_host.empty() ? options.link_host
                : everywhere                 ? outside_address()
                                             : options.listen.address;
    link.port = access.name && access.name->port != 0 ? access.name->port : server->port();
    link.fingerprint = linked_certificate().fingerprint;
    write_address(state_folder, link);
    note_certificates();
}

const net::Certificate& Host::Impl::linked_certificate() const {
    return (proxy_certificate ? *proxy_certificate : *certificate).current();
}

void Host::Impl::note_certificates() {
    const files::UtcSeconds now = files::utc_now();
    std::vector<HostFigures::Certificate> figures;
    const auto note = [&](const char* of, const KeptCertificate& kept, bool is_in_links) {
        // Browsers see only the one in the links.
        const std::string expected = is_in_links ? link.host : std::string();
        figures.push_back(
            {of, kept.current().fingerprint, kept.validity().ends, kept.problem(now, expected)});
    };
    note("host", *certificate, !proxy_certificate);
    if (proxy_certificate)
        note("proxy", *proxy_certificate, true);
    for (const auto& certificate_now : figures) {
        std::string& told = told_of_certificates[certificate_now.of];
        if (told != certificate_now.problem && !certificate_now.problem.empty())
            log::warning("host", "certificate", {{"problem", certificate_now.problem}});
        told = certificate_now.problem;
    }
    const std::lock_guard lock(figures_mutex);
    certificate_figures = std::move(figures);
}

void Host::follow_certificates() {
    Impl& host = *impl_;
    const bool is_other = host.certificate->follow(
        [&](const net::Certificate& fresh) { host.server->set_certificate(fresh); });
    const bool is_proxys_other =
        host.proxy_certificate && host.proxy_certificate->follow([](const net::Certificate&) {});
    if (is_other)
        log::info("host", "certificate replaced",
                  {{"expires", files::utc_text(host.certificate->validity().ends)}});
    const net::Certificate& linked = host.linked_certificate();
    if (is_proxys_other || (is_other && !host.proxy_certificate)) {
        net::Link address;
        {
            const std::lock_guard lock(host.link_mutex);
            host.link.fingerprint = linked.fingerprint;
            address = host.link;
        }
        try {
            write_address(host.state_folder, address);
        } catch (const Error& error) {
            log::warning("host", "'theatron link' shows old links", {{"problem", error.what()}});
        }
        log::info("host", "links changed with the certificate, browsers can use the old ones");
    }
    host.note_certificates();
}

}  // namespace theatron::host
