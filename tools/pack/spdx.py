# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""spdx: the list of files and licences of the sources, SPDX 2.3 tag-value. A file's licence is what
its head says; .reuse/dep5 speaks for files that can have none.
"""
import fnmatch
import hashlib
import re
import subprocess
import time

from pack.wrappers import ROOT

HEAD = """\
SPDXVersion: SPDX-2.3
DataLicense: CC0-1.0
SPDXID: SPDXRef-DOCUMENT
DocumentName: verican-{version}
DocumentNamespace: https://spdx.org/spdxdocs/verican-{version}-{digest}
Creator: Organization: The VeriCAN authors
Created: {created}
Relationship: SPDXRef-DOCUMENT DESCRIBES SPDXRef-Package

PackageName: verican
SPDXID: SPDXRef-Package
PackageVersion: {version}
PackageDownloadLocation: NOASSERTION
FilesAnalyzed: true
PackageVerificationCode: {digest}
PackageLicenseConcluded: {all}
PackageLicenseDeclared: {all}
{from_files}
PackageCopyrightText: 2026 The VeriCAN authors
"""
FILE = """
FileName: ./{name}
SPDXID: SPDXRef-{number}
FileChecksum: SHA1: {sha1}
FileChecksum: SHA256: {sha256}
LicenseConcluded: {licence}
LicenseInfoInFile: {licence}
FileCopyrightText: 2026 The VeriCAN authors
Relationship: SPDXRef-Package CONTAINS SPDXRef-{number}
"""
IDENTIFIER = re.compile(rb"SPDX-License-Identifier: *([\w.-]+)")


def described():
    """Patterns of .reuse/dep5 with their licences; the last that fits holds."""
    found = []
    for part in (ROOT / ".reuse/dep5").read_text(encoding="utf-8").split("\n\n"):
        fields = dict(re.findall(r"^(\S+): *(.*(?:\n .*)*)", part, re.MULTILINE))
        for pattern in fields.get("Files", "").split():
            found.append((pattern, fields["License"]))
    return found


def licence_of(name, data, patterns):
    """The licence of a file; None: nothing says which."""
    head = IDENTIFIER.search(data[:1500])
    if head:
        return head[1].decode()
    fitting = [licence for pattern, licence in patterns if fnmatch.fnmatch(name, pattern)]
    return fitting[-1] if fitting else None


def licences():
    """Committed file -> (content, licence); the texts of licences themselves are not listed."""
    names = subprocess.run(["git", "ls-files"], cwd=ROOT, check=True, text=True,
                           stdout=subprocess.PIPE).stdout.splitlines()
    patterns = described()
    found = {}
    for name in sorted(names):
        if not name.startswith(("LICENSES/", "LICENSE", ".reuse/")):
            data = (ROOT / name).read_bytes()
            found[name] = data, licence_of(name, data, patterns)
    return found


def render(version, epoch):
    """The text of the list."""
    files = licences()
    unknown = [name for name, (_, licence) in files.items() if licence is None]
    if unknown:
        raise ValueError(f"no licence for {', '.join(unknown)}")
    used = sorted({licence for _, licence in files.values()})
    sums = sorted(hashlib.sha1(data).hexdigest() for data, _ in files.values())
    digest = hashlib.sha1("".join(sums).encode()).hexdigest()
    lines = [HEAD.format(
        version=version, digest=digest, all=" AND ".join(used),
        from_files="\n".join(f"PackageLicenseInfoFromFiles: {name}" for name in used),
        created=time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(epoch)))]
    for number, (name, (data, licence)) in enumerate(files.items()):
        lines.append(FILE.format(name=name, number=number, licence=licence,
                                 sha1=hashlib.sha1(data).hexdigest(),
                                 sha256=hashlib.sha256(data).hexdigest()))
    return "".join(lines)
