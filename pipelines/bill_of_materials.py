#!/usr/bin/env python3
"""An SPDX 2.3 document of Talus and the Debian packages that come with it.

  bill_of_materials.py NAME VERSION DATE <packages

Standard input has a line "package version" for each package; the document goes to standard output.
"""
import json
import re
import sys


def document(name, version, date, packages):
    def package(title, number, **more):
        return {"SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", title), "name": title,
                "versionInfo": number, "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
                **more}
    own = package("talus", version, licenseDeclared="GPL-3.0-or-later")
    others = [package(title, number, externalRefs=[{
        "referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
        "referenceLocator": f"pkg:deb/debian/{title}@{number}"}])
        for title, number in packages if title != "talus"]
    relations = [{"spdxElementId": one, "relationshipType": kind, "relatedSpdxElement": other}
                 for one, kind, other in [("SPDXRef-DOCUMENT", "DESCRIBES", own["SPDXID"]),
                                          *((own["SPDXID"], "DEPENDS_ON", each["SPDXID"])
                                            for each in others)]]
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT",
            "name": name, "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{date}",
            "creationInfo": {"created": f"{date}T00:00:00Z", "creators": ["Tool: talus-release"]},
            "packages": [own, *others], "relationships": relations}


if __name__ == "__main__":
    packages_read = [line.split() for line in sys.stdin if line.strip()]
    print(json.dumps(document(*sys.argv[1:4], packages_read), indent=1))
