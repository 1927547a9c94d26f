# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
"""meshio for the scripts of this folder.  Its reader of .vtu takes base64 to end at the padding, as
b64decode() of later Pythons (Debian 13's 3.13.5) does not: there it is given no more than that."""
import base64
import types

import meshio
import meshio.vtu._vtu


def decode(data):
    padding = data.find("=")
    return base64.b64decode(data if padding < 0 else data[:padding // 4 * 4 + 4])


meshio.vtu._vtu.base64 = types.SimpleNamespace(b64decode=decode, b64encode=base64.b64encode)
