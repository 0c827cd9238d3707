"""Pages of a list of jobs."""

from pydantic import BaseModel, ConfigDict, Field

from jointplay.records.job_id import is_job_id
from jointplay.service.problems import RequestRefused


class PageQuery(BaseModel):
    """One page of the list of jobs."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    page_size: int = Field(default=50, ge=1, le=1000, description="Most jobs in one page.")
    page_token: str | None = Field(default=None, description="next_page_token of the page before.")

    def checked_token(self) -> str | None:
        """Return the token, or refuse one that this service never gave."""
        if self.page_token is not None and not is_job_id(self.page_token):
            raise RequestRefused.of_parameter(
                "page_token",
                "The page_token is not one that this service gave.",
                remedy="Give the next_page_token of a page, or leave it out.",
            )
        return self.page_token
