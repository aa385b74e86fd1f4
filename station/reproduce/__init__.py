"""`station reproduce`: the paper's tables and figures computed here, the published method beside ours."""
