# SPDX-FileCopyrightText: 2026 The VeriCAN authors
# SPDX-License-Identifier: Apache-2.0
"""site_slug: anchors of headings as code hosts make them, which the pages' links use."""
import re


def slug(title, separator):
    """The anchor of a heading: lower case, no punctuation, a separator for each space."""
    return re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", separator)
