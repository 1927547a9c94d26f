# SPDX-FileCopyrightText: The mwmesh authors
# SPDX-License-Identifier: Apache-2.0
# The extension, which only the package itself uses.
from typing import Any

def __getattr__(name: str) -> Any: ...
