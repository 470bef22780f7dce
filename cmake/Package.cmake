# completed in the packaging step
